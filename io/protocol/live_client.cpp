#include "io/protocol/live_client.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "io/files/files.h"
#include "io/json/json.h"
#include "io/protocol/connection.h"
#include "io/protocol/limits.h"
#include "io/protocol/live_blobs.h"
#include "io/protocol/silence_watch.h"

namespace focalstage {

namespace {

LiveCompiled compiled_from(const v1::LiveCompiled& message) {
  LiveCompiled compiled;
  compiled.revision = message.revision();
  compiled.frame = message.frame();
  compiled.compile_ms = message.compile_ms();
  compiled.images = message.images();
  compiled.width_px = message.width_px();
  compiled.height_px = message.height_px();
  compiled.channels = message.channels();
  compiled.frame_file = message.frame_file();
  return compiled;
}

LiveAppeared appeared_from(const v1::LiveAppeared& message) {
  return {message.revision(), message.frame(), message.sweep(), message.edit_to_light_ms()};
}

}  // namespace

/// The stream, a thread that alone writes to it and one that alone reads from it.
struct LiveLink::State {
  explicit State(std::shared_ptr<RigConnection> to_rig) : connection(std::move(to_rig)) {}
  ~State();

  Status begin(const std::string& token, bool share_frames);
  Status enqueue(v1::LiveRequest request);
  void offer(std::vector<AssetFile> files, google::protobuf::RepeatedPtrField<v1::LiveAsset>* named);
  std::optional<v1::LiveRequest> next_to_write();
  void write();
  void read();
  void take(const v1::LiveReply& reply);
  Fault end_fault(const grpc::Status& status) const;

  std::shared_ptr<RigConnection> connection;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReaderWriter<v1::LiveRequest, v1::LiveReply>> stream;

  std::mutex mutex;
  std::condition_variable changed;
  std::deque<v1::LiveRequest> outbox;
  LiveBlobs blobs;
  std::vector<LiveAnswer> answers;
  std::optional<Fault> ended;
  std::uint64_t last_revision = 0;
  std::string project_sha256;  ///< the text offered last
  bool heard_of = false;       ///< the rig answered: it took the link
  bool closing = false;
  bool over = false;  ///< nothing more comes

  std::optional<SilenceWatch> silence;
  std::jthread writer;
  std::jthread reader;
};

LiveLink::State::~State() {
  if (!stream) return;
  {
    std::unique_lock lock(mutex);
    closing = true;
    changed.notify_all();
    changed.wait_for(lock, std::chrono::milliseconds(500), [&] { return over; });
  }
  context.TryCancel();  // of a call that is over: nothing
}

Fault LiveLink::State::end_fault(const grpc::Status& status) const {
  if (silence->fell_silent()) {
    return {"rig.unreachable", connection->address(), "the rig fell silent", "see whether it runs, then begin again"};
  }
  return connection->lost(status);
}

/// Opens the stream and waits until the rig took it, or said why not.
Status LiveLink::State::begin(const std::string& token, bool share_frames) {
  v1::LiveRequest request;
  request.mutable_begin()->set_token(token);
  request.mutable_begin()->set_share_frames(share_frames);
  outbox.push_back(std::move(request));
  stream = connection->stub().Live(&context);
  silence.emplace(live_rig_silence, [this] { context.TryCancel(); });
  writer = std::jthread([this] { write(); });
  reader = std::jthread([this] { read(); });
  std::unique_lock lock(mutex);
  changed.wait(lock, [&] { return heard_of || over; });
  if (!heard_of) return *ended;
  return {};
}

Status LiveLink::State::enqueue(v1::LiveRequest request) {
  constexpr std::size_t room_for_framing = 1024;
  if (request.ByteSizeLong() > message_limit_bytes - room_for_framing) {
    return Fault{"live.too-large", "edits", "these edits are too large for one message", "send the whole project"};
  }
  const std::lock_guard lock(mutex);
  if (ended) return *ended;
  outbox.push_back(std::move(request));
  changed.notify_all();
  return {};
}

void LiveLink::State::offer(std::vector<AssetFile> files, google::protobuf::RepeatedPtrField<v1::LiveAsset>* named) {
  const std::lock_guard lock(mutex);
  for (AssetFile& file : files) {
    v1::LiveAsset* asset = named->Add();
    asset->set_path(file.path);
    asset->set_sha256(file.sha256);
    asset->set_size_bytes(file.bytes.size());
    blobs.offer(file.sha256, std::move(file.bytes));
  }
}

/// What goes out next: edits before chunks, and when there is neither for a while, a word all the same. Nothing once
/// the link closes.
std::optional<v1::LiveRequest> LiveLink::State::next_to_write() {
  std::unique_lock lock(mutex);
  changed.wait_for(lock, live_keepalive, [&] { return !outbox.empty() || blobs.has_chunk() || closing || over; });
  v1::LiveRequest request;
  if (over) return std::nullopt;
  if (!outbox.empty()) {
    request = std::move(outbox.front());
    outbox.pop_front();
  } else if (closing) {
    return std::nullopt;
  } else if (blobs.has_chunk()) {
    *request.mutable_chunk() = blobs.next_chunk();
  } else {
    request.mutable_keepalive();
  }
  return request;
}

void LiveLink::State::write() {
  while (const std::optional<v1::LiveRequest> request = next_to_write()) {
    if (!stream->Write(*request)) return;  // the reader learns why
  }
  v1::LiveRequest end;
  end.mutable_end();
  if (stream->Write(end)) stream->WritesDone();
}

void LiveLink::State::read() {
  v1::LiveReply reply;
  while (stream->Read(&reply)) {
    silence->heard();
    take(reply);
  }
  const grpc::Status status = stream->Finish();
  const std::lock_guard lock(mutex);
  ended = end_fault(status);
  answers.push_back(LiveEnded{*ended});
  over = true;
  changed.notify_all();
}

void LiveLink::State::take(const v1::LiveReply& reply) {
  const std::lock_guard lock(mutex);
  heard_of = true;
  switch (reply.what_case()) {
    case v1::LiveReply::kState:
      std::erase_if(answers, [](const LiveAnswer& answer) { return std::holds_alternative<RigState>(answer); });
      answers.push_back(state_from(reply.state()));
      break;
    case v1::LiveReply::kWanted:
      for (const std::string& sha256 : reply.wanted().sha256()) blobs.ask(sha256);
      break;
    case v1::LiveReply::kCompiled:
      answers.push_back(compiled_from(reply.compiled()));
      break;
    case v1::LiveReply::kAppeared:
      answers.push_back(appeared_from(reply.appeared()));
      break;
    case v1::LiveReply::kRefused:
      answers.push_back(LiveRefused{reply.refused().revision(), fault_from(reply.refused().fault())});
      break;
    case v1::LiveReply::WHAT_NOT_SET:
      break;  // of a newer rig
  }
  changed.notify_all();
}

LiveLink::LiveLink(std::unique_ptr<State> state) : state_(std::move(state)) {}
LiveLink::LiveLink(LiveLink&&) noexcept = default;
LiveLink& LiveLink::operator=(LiveLink&&) noexcept = default;
LiveLink::~LiveLink() = default;

Result<LiveLink> LiveLink::start(RigClient& rig, LiveProject project, bool share_frames) {
  for (int attempt = 0;; ++attempt) {
    const Result<std::string> token = rig.connection()->token();
    if (!token) return token.fault();
    auto state = std::make_unique<State>(rig.connection());
    const Status begun = state->begin(*token, share_frames);
    if (!begun && (begun.fault().code != "rig.lease" || attempt > 0)) return begun.fault();
    if (!begun) {
      rig.connection()->forget(*token);
      continue;
    }
    LiveLink link(std::move(state));
    if (Status sent = link.send_project(std::move(project)); !sent) return sent.fault();
    return link;
  }
}

Status LiveLink::send_project(LiveProject project) {
  v1::LiveRequest request;
  v1::LiveProject& message = *request.mutable_project();
  message.set_revision(project.revision);
  message.set_sha256(sha256_hex(project.text));
  message.set_size_bytes(project.text.size());
  message.set_frame(project.frame);
  const auto* text = reinterpret_cast<const std::byte*>(project.text.data());
  {
    const std::lock_guard lock(state_->mutex);
    state_->last_revision = project.revision;
    if (state_->project_sha256 != message.sha256()) state_->blobs.withdraw(state_->project_sha256);
    state_->project_sha256 = message.sha256();
    state_->blobs.offer(message.sha256(), {text, text + project.text.size()});
  }
  state_->offer(std::move(project.files), message.mutable_assets());
  return state_->enqueue(std::move(request));
}

Status LiveLink::send(std::uint64_t revision, const std::vector<Edit>& edits, std::vector<AssetFile> new_files) {
  std::uint64_t base = 0;
  {
    const std::lock_guard lock(state_->mutex);
    base = state_->last_revision;
  }
  return send_onto(base, revision, edits, std::move(new_files));
}

Status LiveLink::send_onto(std::uint64_t base_revision, std::uint64_t revision, const std::vector<Edit>& edits,
                           std::vector<AssetFile> new_files) {
  v1::LiveRequest request;
  v1::LiveEdits& message = *request.mutable_edits();
  message.set_revision(revision);
  message.set_base_revision(base_revision);
  for (const Edit& edit : edits) message.add_edits(write_json(value_from(edit), -1));
  state_->offer(std::move(new_files), message.mutable_assets());
  if (Status queued = state_->enqueue(std::move(request)); !queued) return queued;
  const std::lock_guard lock(state_->mutex);
  state_->last_revision = revision;
  return {};
}

Status LiveLink::show_frame(int frame) {
  v1::LiveRequest request;
  request.mutable_frame()->set_frame(frame);
  return state_->enqueue(std::move(request));
}

std::vector<LiveAnswer> LiveLink::poll() {
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->answers, {});
}

}  // namespace focalstage
