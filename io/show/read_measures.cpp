#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "io/show/read_header.h"

namespace focalstage {
namespace {

/// Shows of other assignments than `optimal` have none of it.
void read_optimal(Hdf5In& in, const std::string& group, std::vector<FrameMeasure>& measures) {
  const std::vector<std::string> names = in.names(group.c_str());
  if (std::find(names.begin(), names.end(), "optimal_tiles") == names.end()) return;
  const Hdf5In::Shape shape{measures.size(), 2};
  const auto tiles = in.numbers<std::uint64_t>((group + "/optimal_tiles").c_str(), shape);
  const auto accepted = in.numbers<std::uint64_t>((group + "/optimal_accepted_tiles").c_str(), shape);
  const auto left = in.numbers<std::uint64_t>((group + "/optimal_left_tiles").c_str(), shape);
  const auto values = in.numbers<std::uint64_t>((group + "/optimal_values").c_str(), shape);
  const auto linear = in.numbers<double>((group + "/optimal_linear_error").c_str(), shape);
  const auto optimal = in.numbers<double>((group + "/optimal_error").c_str(), shape);
  for (const auto* numbers : {&linear, &optimal}) {
    const bool sums =
        std::all_of(numbers->begin(), numbers->end(), [](double d) { return std::isfinite(d) && d >= 0.0; });
    if (!sums) in.refuse(group, "it is no sum of squares");
  }
  if (!in.ok()) return;
  for (std::size_t k = 0; k < measures.size(); ++k) {
    for (const Side side : both_sides) {
      const std::size_t at = 2 * k + index_of(side);
      measures[k].optimal[side] = {tiles[at], accepted[at], left[at], values[at], linear[at], optimal[at]};
    }
  }
}

/// Shows without compensation have none of it.
void read_asked(Hdf5In& in, const std::string& group, std::size_t surfaces, std::vector<FrameMeasure>& measures) {
  const std::vector<std::string> names = in.names(group.c_str());
  if (std::find(names.begin(), names.end(), "surface_lit") == names.end()) return;
  const Hdf5In::Shape shape{measures.size(), surfaces}, by_channel{measures.size(), surfaces, 3};
  const auto lit = in.numbers<std::uint64_t>((group + "/surface_lit").c_str(), shape);
  const auto too_bright = in.numbers<std::uint64_t>((group + "/surface_too_bright").c_str(), shape);
  const auto too_dark = in.numbers<std::uint64_t>((group + "/surface_too_dark").c_str(), shape);
  const auto bright = in.numbers<std::uint64_t>((group + "/surface_bright_in").c_str(), by_channel);
  const auto dark = in.numbers<std::uint64_t>((group + "/surface_dark_in").c_str(), by_channel);
  const auto most = in.numbers<double>((group + "/surface_most").c_str(), shape);
  const auto least = in.numbers<double>((group + "/surface_least").c_str(), shape);
  for (const auto* numbers : {&most, &least}) {
    const bool finite = std::all_of(numbers->begin(), numbers->end(), [](double d) { return std::isfinite(d); });
    if (!finite) in.refuse(group, "it is not finite");
  }
  if (!in.ok()) return;
  for (std::size_t k = 0; k < measures.size(); ++k) {
    for (std::size_t i = 0; i < surfaces; ++i) {
      const std::size_t at = k * surfaces + i;
      measures[k].surfaces.push_back({i,
                                      lit[at],
                                      too_bright[at],
                                      too_dark[at],
                                      {bright[3 * at], bright[3 * at + 1], bright[3 * at + 2]},
                                      {dark[3 * at], dark[3 * at + 1], dark[3 * at + 2]},
                                      most[at],
                                      least[at]});
    }
  }
}

}  // namespace

std::vector<FrameMeasure> read_measures(Hdf5In& in, const ShowHeader& header, std::size_t projector) {
  const std::string group = projector == 0 ? "/measure" : projector_group(projector) + "/measure";
  const std::size_t frames = static_cast<std::size_t>(header.frames);
  const std::size_t objects = header.poses.at(0).objects.size();
  const auto lit = in.numbers<std::uint64_t>((group + "/lit_pixels").c_str(), {frames});
  const auto clipped = in.numbers<std::uint64_t>((group + "/clipped_pixels").c_str(), {frames});
  const auto surface = in.numbers<std::uint64_t>((group + "/surface_pixels").c_str(), {frames});
  const auto defocused = in.numbers<std::uint64_t>((group + "/defocused_pixels").c_str(), {frames});
  const auto worst_defocus_d = in.numbers<double>((group + "/worst_defocus_d").c_str(), {frames});
  const auto samples = in.numbers<std::uint64_t>((group + "/object_samples").c_str(), {frames, objects});
  const auto beyond = in.numbers<std::uint64_t>((group + "/object_beyond").c_str(), {frames, objects});
  const auto worst_beyond_d = in.numbers<double>((group + "/object_worst_beyond_d").c_str(), {frames, objects});
  const auto worst_below_d = in.numbers<double>((group + "/object_worst_below_d").c_str(), {frames, objects});
  const auto worst_above_d = in.numbers<double>((group + "/object_worst_above_d").c_str(), {frames, objects});
  for (const auto* numbers : {&worst_defocus_d, &worst_beyond_d, &worst_below_d, &worst_above_d}) {
    const bool finite = std::all_of(numbers->begin(), numbers->end(), [](double d) { return std::isfinite(d); });
    if (!finite) in.refuse(group, "it is not finite");
  }
  std::vector<FrameMeasure> measures;
  if (!in.ok()) return measures;
  for (std::size_t k = 0; k < frames; ++k) {
    FrameMeasure measure{lit[k], clipped[k], surface[k], defocused[k], worst_defocus_d[k], {}, {}, {}};
    for (std::size_t i = 0; i < objects; ++i) {
      const std::size_t at = k * objects + i;
      measure.objects.push_back({i, samples[at], beyond[at], worst_beyond_d[at], worst_below_d[at], worst_above_d[at]});
    }
    measures.push_back(std::move(measure));
  }
  read_optimal(in, group, measures);
  read_asked(in, group, header.poses.at(0).surfaces.size(), measures);
  return measures;
}

}  // namespace focalstage
