#include "editor/session/sample_cards.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string_view>

#include "core/stage/stage.h"
#include "editor/preview/thumbnail.h"
#include "editor/samples/samples.h"
#include "editor/session/session_state.h"
#include "io/assets/assets.h"
#include "io/project/project_file.h"

namespace focalstage {
namespace {

constexpr int picture_width_px = 432;
constexpr int picture_height_px = 288;

struct Described {
  std::string_view name;
  std::string_view says;
};

/// In the order in which they are best met.
constexpr std::array<Described, 11> descriptions{{
    {"first-light", "A near rabbit and a far teapot on a slanted screen. Begin here."},
    {"three-rabbits", "Near, middle and far, each sharp with the real block beside it."},
    {"step-teapot", "A turning teapot across a real step, sharp on both planes."},
    {"corner-cuboids", "Two cuboids of different heights in a real corner."},
    {"moving-plane", "A rabbit that stays put while a hand moves the board."},
    {"slanted-checker", "A plane that runs through every slice without a seam."},
    {"depth-matching", "The user study: a target to be matched with a real pointer."},
    {"occlusion", "A near card before a far one, right at every focus."},
    {"moving-pictures", "Pictures on objects: 16 bits, a sequence that plays, a leaf cut out."},
    {"painted-wall", "Even light on bricks that lean away: codes make up for paint and black."},
    {"two-projectors", "Two projectors on a folded screen, seen as one."},
}};

std::size_t place_of(std::string_view name) {
  const auto at = std::ranges::find(descriptions, name, &Described::name);
  return static_cast<std::size_t>(at - descriptions.begin());
}

std::string title_from(std::string_view name) {
  std::string title(name);
  std::ranges::replace(title, '-', ' ');
  if (!title.empty()) title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

Result<EyePicture> picture_of(const std::string& name, std::stop_token stop) {
  const auto sample = sample_named(name);
  if (!sample) return sample.fault();
  std::vector<AssetFile> files;
  std::string_view text;
  for (const SampleFile& file : sample->files) {
    const auto bytes = std::as_bytes(std::span(file.bytes.data(), file.bytes.size()));
    if (file.path == name + ".focal") text = file.bytes;
    files.push_back({std::string(file.path), {}, SharedBytes(bytes.data(), bytes.data() + bytes.size())});
  }
  const auto loaded = parse_project(text, name);
  if (!loaded) return loaded.fault();
  const auto assets = assets_from(loaded->project, files);
  if (!assets) return assets.fault();
  auto stood = stage(loaded->project, *assets, 0.0);
  if (!stood) return stood.fault();
  return paint_thumbnail(loaded->project, std::make_shared<const Stage>(std::move(*stood)), picture_width_px,
                         picture_height_px, std::move(stop));
}

}  // namespace

std::vector<SampleCard> make_sample_cards() {
  std::vector<SampleCard> cards;
  for (const Sample& sample : samples()) {
    const std::size_t place = place_of(sample.name);
    const std::string_view says = place < descriptions.size() ? descriptions[place].says : std::string_view();
    cards.push_back({std::string(sample.name), title_from(sample.name), std::string(says), nullptr});
  }
  std::ranges::stable_sort(cards, {}, [](const SampleCard& card) { return place_of(card.name); });
  return cards;
}

void Session::State::draw_next_sample() {
  drawing_samples = !document && samples_drawn < sample_cards.size();
  if (!drawing_samples) return;
  const std::size_t index = samples_drawn;
  const std::string name = sample_cards[index].name;
  jobs.start(
      "Draw " + name,
      [this, index, name](const Jobs::Progress&, std::stop_token stop) -> Jobs::Finish {
        auto drawn = std::make_shared<Result<EyePicture>>(picture_of(name, std::move(stop)));
        return [this, index, drawn] {
          // Without a picture the card still opens its sample.
          if (*drawn) sample_cards[index].picture = std::make_shared<const EyePicture>(std::move(**drawn));
          samples_drawn = index + 1;
          draw_next_sample();
        };
      },
      true);
}

}  // namespace focalstage
