#include "editor/session/session.h"

#include <algorithm>
#include <utility>

#include "editor/session/session_state.h"

namespace focalstage {

Session::Session(std::function<void()> wake)
    : state_(std::make_unique<State>(std::move(wake), UserFolders::of_environment())) {}

Session::~Session() = default;

Status Session::run(std::string_view command, const Value& args) {
  const Command* found = command_named(command);
  Status done;
  if (!found) {
    done = Fault{"command.unknown", std::string(command), "there is no such command", "see the palette (Ctrl+P)"};
  } else if (std::string why = found->unavailable(*this); !why.empty()) {
    done = Fault{"command.unavailable", std::string(found->title), why, ""};
  } else {
    done = found->run(*this, args);
  }
  if (!done) state_->say(LogLine::Kind::fault, describe(done.fault()));
  return done;
}

Status Session::edit(std::string words, std::vector<Edit> edits) {
  end_drag();
  return state_->apply(std::move(words), std::move(edits));
}

Status Session::drag(std::string words, std::vector<Edit> edits) {
  state_->dragging = true;
  const Joining joining = state_->drag_has_step ? Joining::continues_last : Joining::own_step;
  Status applied = state_->apply(std::move(words), std::move(edits), joining);
  if (applied) state_->drag_has_step = true;
  return applied;
}

void Session::end_drag() {
  if (!state_->dragging) return;
  state_->dragging = false;
  state_->drag_has_step = false;
  state_->wish_preview();
}

bool Session::dragging() const { return state_->dragging; }
bool Session::has_document() const { return state_->document.has_value(); }
const Document& Session::document() const { return *state_->document; }
const Project& Session::project() const { return state_->project(); }
std::uint64_t Session::revision() const { return state_->revision(); }
const std::shared_ptr<const ProjectorModels>& Session::models() const { return state_->models; }
const std::shared_ptr<const Stage>& Session::stage() const { return state_->stage; }
const Selection& Session::selection() const { return state_->selection; }

void Session::select(std::vector<Thing> things) {
  if (things != state_->selection.things) state_->view.key_time_s.reset();
  state_->selection.things = std::move(things);
  state_->tidy();
}

const ViewState& Session::view() const { return state_->view; }
ViewState& Session::view() { return state_->view; }
std::shared_ptr<const CompiledSlices> Session::slices() const { return state_->preview.slices(); }
std::shared_ptr<const CheckedProject> Session::checked() const { return state_->preview.checked(); }
std::shared_ptr<const EyePicture> Session::eye_picture() const { return state_->preview.eye_picture(); }

void Session::want_eye_size(int width_px, int height_px) {
  state_->eye_size_px = {std::clamp(width_px, 16, 2048), std::clamp(height_px, 16, 2048)};
}

void Session::focus_at(glm::dvec2 at) {
  const int serial = state_->focus_question ? state_->focus_question->serial + 1 : 1;
  state_->focus_question = FocusQuestion{serial, at};
  state_->wish_preview();
}

void Session::read_pixel(Side side, glm::ivec2 pixel) { state_->reader.ask(slices(), side, pixel); }
std::shared_ptr<const PixelReading> Session::pixel_reading() const { return state_->reader.answer(); }
bool Session::compiling() const { return state_->preview.busy(); }
std::optional<Fault> Session::compile_fault() const { return state_->preview.fault(); }

std::shared_ptr<const SolveOffer> Session::solve_offer() const {
  const auto& offer = state_->solve_offer;
  return offer && offer->revision == revision() ? offer : nullptr;
}

const RigLink& Session::rig() const { return state_->rig; }
const Log& Session::log() const { return state_->log; }
const std::vector<Task>& Session::tasks() const { return state_->jobs.tasks(); }
void Session::cancel_task(int id) { state_->jobs.cancel(id); }
const std::optional<LogLine>& Session::notice() const { return state_->notice; }
void Session::dismiss_notice() { state_->notice.reset(); }
const std::vector<std::filesystem::path>& Session::recent() const { return state_->recent; }
const std::vector<Recovery>& Session::left_behind() const { return state_->left_behind; }
const std::vector<SampleCard>& Session::sample_cards() const { return state_->sample_cards; }

void Session::want_sample_pictures() {
  if (!state_->drawing_samples) state_->draw_next_sample();
}

const std::vector<std::string>& Session::recent_rigs() const { return state_->recent_rigs; }
bool Session::palette_open() const { return state_->palette_open; }
void Session::close_palette() { state_->palette_open = false; }
FileWish Session::file_wish() const { return state_->file_wish; }

void Session::forget_file_wish() {
  state_->file_wish = FileWish::none;
  state_->import_replaces = {};
  state_->import_look_of.clear();
  state_->after_save = nullptr;
}

bool Session::wants_to_quit() const { return state_->quitting; }

std::vector<Finding> Session::findings() const {
  std::vector<Finding> findings = state_->asset_findings;
  findings.insert(findings.end(), state_->rig_findings.begin(), state_->rig_findings.end());
  if (const auto known = checked()) findings.insert(findings.end(), known->findings.begin(), known->findings.end());
  return findings;
}

const Question* Session::question() const { return state_->asked ? &state_->asked->question : nullptr; }

void Session::answer(std::size_t choice) {
  if (!state_->asked) return;
  const Asked asked = *std::exchange(state_->asked, std::nullopt);
  if (choice < asked.answers.size()) asked.answers[choice]();
}

}  // namespace focalstage
