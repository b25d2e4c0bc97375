#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>

#include "core/base/number_words.h"
#include "core/schedule/shape_words.h"
#include "core/schedule/sweep_shape.h"
#include "editor/cli/command_list.h"
#include "editor/cli/edit_file.h"
#include "editor/cli/look_words.h"
#include "editor/cli/output.h"
#include "editor/cli/power_file.h"

namespace focalstage {
namespace {

struct Options {
  std::string project;
  std::string output;
  std::string power;
  std::optional<int> max_harmonic;
  bool json = false;
};

Edit waveform_edit(const PerEye<MeasuredWaveform>& waveform) {
  return {Edit::Kind::set, "sweep", "", "waveform", waveform_value(waveform)};
}

/// The exposure of the same image for the same eye; null where it is not shown.
const Slot* same_slot(const Timing& timing, int image, Side eye) {
  const auto found = std::find_if(timing.slots.begin(), timing.slots.end(),
                                  [&](const Slot& slot) { return slot.image == image && slot.eye == eye; });
  return found == timing.slots.end() ? nullptr : &*found;
}

// For programs ------------------------------------------------------------------------------------------------------

Value value_of(const Slot* slot) {
  if (slot == nullptr) return {};
  return Value::Object{{"start_s", slot->start_s}, {"power_d", slot->power_d}, {"smear_d", slot->smear_d}};
}

Value value_of(const DriveLoad& load) { return Value::Object{{"peak_a", load.peak_a}, {"rms_a", load.rms_a}}; }

Value both(Value sine, Value shaped) { return Value::Object{{"sine", std::move(sine)}, {"shaped", std::move(shaped)}}; }

Value slots_value(const SweepShape& shape, const std::vector<ImageSpec>& images) {
  Value::Array slots;
  for (std::size_t image = 0; image < images.size(); ++image) {
    for (const Side eye : both_sides) {
      const Slot* const sine = same_slot(shape.sine, static_cast<int>(image), eye);
      const Slot* const shaped = same_slot(shape.shaped, static_cast<int>(image), eye);
      if (!sine && !shaped) continue;
      slots.push_back(Value::Object{{"image", static_cast<double>(image)},
                                    {"eye", eye_word(eye)},
                                    {"power_d", images[image].power_d},
                                    {"sine", value_of(sine)},
                                    {"shaped", value_of(shaped)}});
    }
  }
  return slots;
}

Value bounds_value(const SweepShape& shape) {
  Value::Array bounds;
  for (const ShapeBound& bound : shape.bounds) {
    bounds.push_back(Value::Object{{"limit", name_of(bound.limit)},
                                   {"needed", bound.needed},
                                   {"allowed", bound.allowed},
                                   {"unit", unit_of(bound.limit)},
                                   {"message", describe(bound)}});
  }
  return bounds;
}

void print_values(const SweepShape& shape, const Project& project, const std::string& file, double took_ms) {
  const auto shaped = [&](Value value) { return shape.better ? std::move(value) : Value(); };
  print_json(Value::Object{
      {"better", shape.better},
      {"project", file.empty() ? Value() : Value(file)},
      {"highest_harmonic", shape.highest_harmonic},
      {"highest_frequency_hz", shape.highest_harmonic * project.sweep.frequency_hz},
      {"worst_smear_d", both(worst_smear_d(shape.sine), shaped(worst_smear_d(shape.shaped)))},
      {"mean_smear_d", both(mean_smear_d(shape.sine), shaped(mean_smear_d(shape.shaped)))},
      {"left_drive", both(value_of(shape.sine_load.left), shaped(value_of(shape.shaped_load.left)))},
      {"right_drive", both(value_of(shape.sine_load.right), shaped(value_of(shape.shaped_load.right)))},
      {"slots", slots_value(shape, image_plan(project))},
      {"bounds", bounds_value(shape)},
      {"milliseconds", took_ms},
  });
}

// For people --------------------------------------------------------------------------------------------------------

std::vector<std::string> row_of(const SweepShape& shape, const ImageSpec& image, int number, Side eye) {
  const Slot* const sine = same_slot(shape.sine, number, eye);
  const Slot* const shaped = same_slot(shape.shaped, number, eye);
  const auto at = [](const Slot* slot) {
    return slot ? fixed_text((slot->start_s + slot->exposure_s / 2.0) * 1000.0, 3) : std::string("-");
  };
  const auto smear = [](const Slot* slot) { return slot ? fixed_text(slot->smear_d, 4) : std::string("-"); };
  return {fixed_text(image.power_d, 3), eye_word(eye), at(sine), smear(sine), at(shaped), smear(shaped)};
}

void print_table(const SweepShape& shape, const std::vector<ImageSpec>& images) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t image = 0; image < images.size(); ++image) {
    for (const Side eye : both_sides) {
      const int number = static_cast<int>(image);
      if (!same_slot(shape.sine, number, eye) && !same_slot(shape.shaped, number, eye)) continue;
      rows.push_back(row_of(shape, images[image], number, eye));
    }
  }
  const std::vector<Column> columns{{"slice D", true},      {"eye"},          {"sine at ms", true}, {"smear D", true},
                                    {"shaped at ms", true}, {"smear D", true}};
  std::fputs(table_text(columns, rows).c_str(), stdout);
}

void print_load(const char* lens, const DriveLoad& sine, const DriveLoad& shaped) {
  std::printf("%s lens: %s mA at the peak, %s mA root mean square; the sine takes %s and %s mA\n", lens,
              fixed_text(shaped.peak_a * 1000.0, 1).c_str(), fixed_text(shaped.rms_a * 1000.0, 1).c_str(),
              fixed_text(sine.peak_a * 1000.0, 1).c_str(), fixed_text(sine.rms_a * 1000.0, 1).c_str());
}

void print_words(const SweepShape& shape, const Project& project, double took_ms) {
  print_table(shape, image_plan(project));
  if (shape.better) {
    std::printf("worst smear %s D instead of %s D, mean %s D instead of %s D, with harmonics up to %d (%s Hz)\n",
                fixed_text(worst_smear_d(shape.shaped), 4).c_str(), fixed_text(worst_smear_d(shape.sine), 4).c_str(),
                fixed_text(mean_smear_d(shape.shaped), 4).c_str(), fixed_text(mean_smear_d(shape.sine), 4).c_str(),
                shape.highest_harmonic, short_text(shape.highest_harmonic * project.sweep.frequency_hz).c_str());
    print_load("left", shape.sine_load.left, shape.shaped_load.left);
    print_load("right", shape.sine_load.right, shape.shaped_load.right);
  } else {
    std::puts("nothing better than the sine within these limits:");
  }
  for (const ShapeBound& bound : shape.bounds) std::printf("- %s\n", describe(bound).c_str());
  std::printf("found in %s ms\n", fixed_text(took_ms, 0).c_str());
}

ExitStatus shape(const Options& options, const LoadedProject& loaded) {
  const auto begun = std::chrono::steady_clock::now();
  const auto found = shape_sweep(loaded.project, image_plan(loaded.project), {options.max_harmonic});
  if (!found) return report(found.fault());
  const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
  std::string file;
  if (found->better) {
    const auto saved = apply_and_save(loaded, {waveform_edit(found->waveform)}, options.output);
    if (!saved) return report(saved.fault());
    file = saved->string();
  }
  if (options.json) {
    print_values(*found, loaded.project, file, took_ms);
  } else {
    print_words(*found, loaded.project, took_ms);
    if (!file.empty()) std::printf("%s: saved\n", file.c_str());
  }
  return found->better ? ExitStatus::done : ExitStatus::findings;
}

/// The power as it is wanted, with its drive.
ExitStatus take_power(const Options& options, const LoadedProject& loaded) {
  const auto power_d = read_power(options.power);
  if (!power_d) return report(power_d.fault());
  PerEye<MeasuredWaveform> waveform;
  PerEye<DriveLoad> load;
  for (const Side eye : both_sides) {
    auto wanted = wanted_waveform((*power_d)[eye], loaded.project.glasses, eye);
    if (!wanted)
      return report(Fault{wanted.fault().code, options.power, wanted.fault().where + " " + wanted.fault().message,
                          wanted.fault().remedy});
    load[eye] = load_of(wanted->drive_a);
    waveform[eye] = std::move(*wanted);
  }
  const auto saved = apply_and_save(loaded, {waveform_edit(waveform)}, options.output);
  if (!saved) return report(saved.fault());
  if (options.json) {
    print_json(Value::Object{
        {"project", saved->string()}, {"left_drive", value_of(load.left)}, {"right_drive", value_of(load.right)}});
  } else {
    std::printf("%s: the power of %s, driven with at most %s A\n", saved->c_str(), options.power.c_str(),
                short_text(std::max(load.left.peak_a, load.right.peak_a)).c_str());
  }
  return ExitStatus::done;
}

ExitStatus run(const Options& options) {
  const auto loaded = load_project(options.project);
  if (!loaded) return report(loaded.fault());
  return options.power.empty() ? shape(options, *loaded) : take_power(options, *loaded);
}

}  // namespace

Command::Run declare_shape(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("PROJECT", options->project, "a NAME.focal, or the folder that holds it")->required()->type_name("");
  app.add_option("-o,--output", options->output, "where to save; the project itself by default")->type_name("OUT");
  auto* const harmonic = app.add_option("--max-harmonic", options->max_harmonic, "the highest harmonic to use")
                             ->type_name("N")
                             ->check(CLI::Range(1, most_shaped_harmonics));
  app.add_option("--power", options->power,
                 "take the power of one period from a file (one sample a line, two columns for left and right) in "
                 "place of the best one")
      ->type_name("FILE")
      ->excludes(harmonic);
  app.add_flag("--json", options->json, "print the outcome as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
