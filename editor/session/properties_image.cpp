// Pictures and sequences of pictures on objects.
#include "core/scene/fields_image.h"
#include "core/scene/sequence.h"
#include "editor/session/edits.h"
#include "editor/session/property_rows.h"

namespace focalstage {
namespace {

/// A choice of words; `fresh`: what it is without one in the file.
Property& word_row(PropertyRows& rows, const char* label, const char* key, std::vector<PropertyChoice> choices,
                   const char* fresh) {
  Property& row = rows.choice(label, key, std::move(choices));
  if (row.value.is_null()) row.value = Value(fresh);
  return row;
}

void add_sequence_rows(PropertyRows& rows) {
  Property& first = rows.number<ImageAppearance>("first picture", "appearance/image/first", {"", 0, 0.1});
  first.help = "The number in its name.";
  if (first.value.is_null()) first.fresh = Value(2);
  rows.number<ImageAppearance>("pictures", "appearance/image/count", {"", 0, 0.1});
  rows.number<ImageAppearance>("rate", "appearance/image/rate_hz", {"Hz", 3, 0.01}).help = "Pictures per second.";
  Property& start = rows.number<ImageAppearance>("start", "appearance/image/start_s", {"s", 3, 0.01});
  start.help = "When the first picture comes, on the project's clock.";
  start.fresh = Value(0.5);
  word_row(rows, "afterwards", "appearance/image/loop",
           {{Value("loop"), "from the first again"},
            {Value("hold"), "the last stays"},
            {Value("once"), "nothing"},
            {Value("ping-pong"), "back and forth"}},
           "loop");
}

/// A name without a place for numbers makes one picture of a sequence.
std::vector<Edit> set_picture_file(const PropertyScope& scope, const Thing& thing, const Property&,
                                   const Value& value) {
  const Value item = item_of(scope.project, thing);
  const Value* found = value_at(item, {"appearance", "image"});
  if (!found || !value.text()) return {};
  Value image = *found;
  if (image.find("count") && !has_number_place(*value.text())) {
    for (const char* key : {"count", "first", "rate_hz", "start_s", "loop"}) image.erase(key);
  }
  image.set("file", value);
  return {set_edit(thing, "appearance/image", image)};
}

}  // namespace

void add_image_rows(PropertyRows& rows) {
  Property& file = rows.text("file", "appearance/image/file");
  file.help = "In the project's folder; of a sequence, # stands for its numbers.";
  file.edits = set_picture_file;
  if (rows.at("appearance").find("image")->find("count")) add_sequence_rows(rows);
  word_row(rows, "beyond the edge", "appearance/image/wrap",
           {{Value("clamp"), "its border"}, {Value("repeat"), "again"}, {Value("mirror"), "mirrored"}}, "clamp");
  word_row(rows, "between pixels", "appearance/image/filter",
           {{Value("linear"), "smooth"}, {Value("nearest"), "squares"}}, "linear");
  word_row(rows, "colour space", "appearance/image/color_space",
           {{Value("srgb"), "sRGB"}, {Value("linear"), "linear light"}}, "srgb");
  rows.flag("lit", "appearance/image/lit").help = "Whether the lights act on it.";
  Property& cutoff = rows.number<ImageAppearance>("cut below", "appearance/image/alpha_cutoff", {"", 2, 0.005});
  cutoff.help = "What is less opaque is cut away; 0: nothing is.";
  cutoff.fresh = Value(0.5);
}

}  // namespace focalstage
