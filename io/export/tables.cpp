#include "io/export/tables.h"

#include "core/scene/number_text.h"
#include "io/export/image_name.h"

namespace focalstage {
namespace {

/// One line of comma-separated fields; none of ours holds a comma or a quote.
class Row {
 public:
  Row& operator<<(const std::string& field) {
    if (!line_.empty()) line_ += ',';
    line_ += field;
    return *this;
  }
  Row& operator<<(double number) { return *this << number_text(number); }
  Row& operator<<(int number) { return *this << std::to_string(number); }

  std::string line() const { return line_ + "\n"; }

 private:
  std::string line_;
};

}  // namespace

std::string schedule_csv(const ShowHeader& header) {
  std::string csv = "slot,image,eye,kind,slice,start_s,exposure_s,trigger_s,power_d,smear_d\n";
  int number = 0;
  for (const Slot& slot : header.schedule.slots) {
    const ImageSpec& image = header.images[static_cast<std::size_t>(slot.image)];
    Row row;
    row << number++ << slot.image << (slot.eye == Side::left ? "left" : "right") << name_of(image.kind) << image.slice;
    row << slot.start_s << slot.exposure_s << slot.trigger_s << slot.power_d << slot.smear_d;
    csv += row.line();
  }
  return csv;
}

std::string waveform_csv(const ShowHeader& header) {
  const Schedule& schedule = header.schedule;
  const std::size_t samples = schedule.lens_power_d.left.size();
  std::string csv = "time_s,left_power_d,right_power_d,left_drive_a,right_drive_a\n";
  for (std::size_t k = 0; k < samples; ++k) {
    Row row;
    row << schedule.period_s * static_cast<double>(k) / static_cast<double>(samples);
    for (const auto* lens : {&schedule.lens_power_d, &schedule.lens_drive_a})
      for (const Side side : both_sides) row << (*lens)[side][k];
    csv += row.line();
  }
  return csv;
}

}  // namespace focalstage
