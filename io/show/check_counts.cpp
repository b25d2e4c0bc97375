#include "io/show/check_counts.h"

#include <algorithm>

#include "io/project/project_file.h"

namespace focalstage {

Status check_counts(const ShowHeader& header, const std::string& source) {
  const Result<LoadedProject> loaded = parse_project(header.project_text, source + ": /project");
  if (!loaded) return loaded.fault();
  const Project& project = loaded->project;
  const auto differs = [&](const std::string& dataset, const std::string& message) {
    return Fault{"show.invalid", source + ": " + dataset, message, "compile the show again"};
  };
  const FramePoses& poses = header.poses.at(0);
  if (poses.surfaces.size() != project.surfaces.size())
    return differs("/pose/surfaces", "it has not the surfaces of /project");
  if (poses.objects.size() != project.objects.size())
    return differs("/pose/objects", "it has not the objects of /project");
  if (header.projectors() > std::max<std::size_t>(project.projectors.size(), 1))
    return differs("/projector", "it has more projectors than /project");
  for (std::size_t i = 0; i < header.projectors(); ++i) {
    const std::vector<ImageSpec> images = header.projector(i).images;
    const bool known = std::all_of(images.begin(), images.end(), [&](const ImageSpec& image) {
      return image.slice < static_cast<int>(project.slices.powers_d.size());
    });
    if (!known) return differs(projector_group(i) + "/image/slice", "it names a slice that /project has not");
  }
  return {};
}

}  // namespace focalstage
