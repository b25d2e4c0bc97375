#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/rigid.h"
#include "core/base/sides.h"
#include "core/mesh/texture.h"
#include "core/scene/process.h"
#include "core/scene/value.h"

namespace focalstage {

/// Members a file carried that this version does not know: kept on save, reported on load.
using Unknown = Value::Object;

struct Keyframe {
  double time_s = 0.0;
  Rigid pose;
  Unknown unknown{};
  bool operator==(const Keyframe&) const = default;
};

/// Where a thing stands: its own pose, or its keys (linear, slerp), or the tracked body named `track`.
struct Placement {
  Rigid pose;
  std::vector<Keyframe> keys;
  std::string track;
  bool operator==(const Placement&) const = default;
};

struct Viewer {
  Placement placement;  ///< the midpoint of the pupils
  double interpupillary_mm = 63.0;
  Unknown unknown{};
  bool operator==(const Viewer&) const = default;
};

/// One harmonic of a lens: amperes in, dioptres out. Harmonic 0 is the static gain.
struct LensHarmonic {
  int harmonic = 0;
  double gain_d_per_a = 40.0;
  double phase_deg = 0.0;  ///< how far the power is ahead of the drive; a lag is negative
  Unknown unknown{};
  bool operator==(const LensHarmonic&) const = default;
};

/// Empty: 40 D/A at every harmonic, no lag.
using LensResponse = std::vector<LensHarmonic>;

/// What a drive may ask of a lens. The defaults are those of an EL-16-40-TC on Optotune's Lens Driver 4: 0.29 A is what
/// the driver can put out, 0.25 A the nominal control current, which the coil bears as heat for as long as one likes.
struct LensLimits {
  double max_current_a = 0.29;             ///< either way
  double max_rms_current_a = 0.25;         ///< root mean square over a period: heat
  std::optional<double> max_frequency_hz;  ///< of the highest harmonic; without: as far as the response was measured
  Unknown unknown{};
  bool operator==(const LensLimits&) const = default;
};

struct Glasses {
  double lens_to_pupil_mm = 15.0;
  std::array<double, 2> lens_range_d{-10.0, 10.0};
  double lens_aperture_mm = 16.0;
  double shutter_close_ms = 0.1;
  double shutter_open_ms = 3.0;
  PerEye<LensResponse> lens_response;
  Unknown lens_response_unknown{};  ///< beside "left" and "right"
  std::optional<LensLimits> lens_limits;
  Unknown unknown{};
  bool operator==(const Glasses&) const = default;
};

/// A measured period: uniform samples from the minimum of the power.
struct MeasuredWaveform {
  std::vector<double> power_d;
  std::vector<double> drive_a;
  Unknown unknown{};
  bool operator==(const MeasuredWaveform&) const = default;
};

/// Nothing measured: a sine.
using Waveform = std::optional<MeasuredWaveform>;

struct Sweep {
  double frequency_hz = 60.0;
  double min_power_d = -1.5;
  double max_power_d = 1.5;
  PerEye<Waveform> waveform;
  Unknown waveform_unknown{};  ///< beside "left" and "right"
  Unknown unknown{};
  bool operator==(const Sweep&) const = default;
};

enum class ColorMode { gray, rgb };

/// How a projector's pixels lie. Diamond, as mirrors that stand on a corner do: every odd row (the first is row 0) lies
/// half a pixel further to the right, and rows are half as far apart as columns.
enum class PixelLayout { square, diamond };

struct Projector {
  std::string name;
  std::string model = "dynaflash";
  int width_px = 1024;
  int height_px = 768;
  PixelLayout pixel_layout = PixelLayout::square;
  double frames_per_second = 2000.0;
  int bits = 8;
  ColorMode color = ColorMode::gray;
  double latency_ms = 0.0;
  double gamma = 1.0;
  /// Measured, in place of `gamma`: what evenly spaced codes from 0 to the highest give, as shares of the way from
  /// black to white; from 0 to 1, never falling. Empty: `gamma`.
  std::vector<double> transfer;
  double black_level = 0.0;  ///< what code 0 lets through, as a share of the light of full white
  double fx_px = 1400.0;
  double fy_px = 1400.0;
  double cx_px = 512.0;
  double cy_px = 384.0;
  std::vector<double> distortion;  ///< OpenCV's order, 0, 4, 5 or 8 of them
  Rigid pose;                      ///< world from projector
  std::optional<double> exposure_ms;
  std::optional<double> focus_m;
  std::optional<double> depth_of_field_d;
  std::optional<double> lumens;
  /// Where others light the same surfaces (docs/blending.md): how far, in its own pixels, its share of the light runs
  /// out towards the edge of its picture and of what shadows it.
  double blend_margin_px = 64.0;
  Unknown unknown{};
  bool operator==(const Projector&) const = default;
};

enum class Assignment { nearest, linear, optimal };
enum class Breathing { exact, planar, off };

/// What codes make up for (docs/colour.md). off: nothing, light falls as if every surface were white and equally far.
/// albedo: the surface's own colour and the projector's black level. even: also how light thins with distance and
/// angle.
enum class CompensationMode { off, albedo, even };

/// Radiometric compensation: what is wanted is what comes back from the surface.
struct Compensation {
  CompensationMode mode = CompensationMode::off;
  double white = 1.0;  ///< what a wanted 1 comes back as: 1 is full code on a white surface; less leaves room
  std::optional<double>
      reference_m;  ///< even: how far from the projector light counts as 1; without: its focus, or 1 m
  Unknown unknown{};
  bool operator==(const Compensation&) const = default;
};

struct Slices {
  std::vector<double> powers_d;
  Assignment assignment = Assignment::linear;
  Breathing breathing = Breathing::exact;
  int samples_per_pixel = 1;  ///< a square number: 1, 4, 9, 16
  Compensation compensation{};
  Unknown unknown{};
  bool operator==(const Slices&) const = default;
};

struct Frames {
  int count = 1;
  double rate_hz = 60.0;
  Unknown unknown{};
  bool operator==(const Frames&) const = default;
};

// Meshes ------------------------------------------------------------------------------------------------------------

struct FileMesh {
  std::string file;
  bool operator==(const FileMesh&) const = default;
};
struct PlaneMesh {
  glm::dvec2 size_m{1.0};
  bool operator==(const PlaneMesh&) const = default;
};
struct BoxMesh {
  glm::dvec3 size_m{1.0};
  bool operator==(const BoxMesh&) const = default;
};
struct SphereMesh {
  double radius_m = 0.5;
  bool operator==(const SphereMesh&) const = default;
};
struct CornerMesh {
  glm::dvec2 size_m{1.0};  ///< the size of one wing
  double angle_deg = 90.0;
  bool operator==(const CornerMesh&) const = default;
};
struct StepMesh {
  glm::dvec2 size_m{1.0};  ///< the whole
  double depth_m = 0.1;
  bool operator==(const StepMesh&) const = default;
};
struct TeapotMesh {
  bool operator==(const TeapotMesh&) const = default;
};
struct RabbitMesh {
  bool operator==(const RabbitMesh&) const = default;
};

using MeshShape = std::variant<FileMesh, PlaneMesh, BoxMesh, SphereMesh, CornerMesh, StepMesh, TeapotMesh, RabbitMesh>;

struct MeshSource {
  MeshShape shape = PlaneMesh{};
  std::vector<ProcessStep> process;
  Unknown unknown{};
  bool operator==(const MeshSource&) const = default;
};

// Things ------------------------------------------------------------------------------------------------------------

struct UnlitAppearance {
  glm::dvec3 color{1.0};  ///< linear RGB
  bool operator==(const UnlitAppearance&) const = default;
};
struct CheckerAppearance {
  glm::ivec2 squares{8, 8};
  glm::dvec3 a{1.0};
  glm::dvec3 b{0.0};
  Unknown unknown{};
  bool operator==(const CheckerAppearance&) const = default;
};

/// What a sequence of pictures shows once all of them were shown. Before its start all but `once` show the first.
enum class SequenceEnd { loop, hold, once, ping_pong };

/// A picture file over the mesh's UV, or a sequence of them on the project's clock (core/scene/sequence.h).
struct ImageAppearance {
  std::string file;      ///< "poster.png"; of a sequence "fire_####.png", where each # stands for a digit
  int count = 0;         ///< pictures of the sequence; 0: no sequence
  int first = 1;         ///< the number in the first one's name
  double rate_hz = 0.0;  ///< pictures per second; of a sequence only
  double start_s = 0.0;  ///< when the first one comes, on the project's clock
  SequenceEnd end = SequenceEnd::loop;
  Wrap wrap = Wrap::clamp;  ///< along u and v
  Magnify filter = Magnify::linear;
  ColorSpace color_space = ColorSpace::srgb;
  bool lit = false;                    ///< whether the project's lights act on it
  std::optional<double> alpha_cutoff;  ///< what is less opaque is cut away; without: all of it is drawn opaque
  Unknown unknown{};
  bool operator==(const ImageAppearance&) const = default;
};

/// The material of the file, lit by the project's lights.
struct MaterialAppearance {
  bool operator==(const MaterialAppearance&) const = default;
};
using Appearance = std::variant<MaterialAppearance, UnlitAppearance, CheckerAppearance, ImageAppearance>;

/// What share of the light that falls on it a surface scatters back, evenly to all sides, by colour.
struct PlainAlbedo {
  glm::dvec3 color{1.0};  ///< linear RGB
  bool operator==(const PlainAlbedo&) const = default;
};
/// A picture of the surface (sRGB) over its mesh's UV.
struct FileAlbedo {
  std::string file;
  Unknown unknown{};
  bool operator==(const FileAlbedo&) const = default;
};
/// What the material of the surface's own file says, lights left aside.
struct MaterialAlbedo {
  bool operator==(const MaterialAlbedo&) const = default;
};
using Albedo = std::variant<PlainAlbedo, FileAlbedo, MaterialAlbedo>;

enum class DepthMode { placed, fixed, offset, slice };

/// Where the picture of an object comes into focus.
struct Depth {
  DepthMode mode = DepthMode::placed;
  double vergence_d = 0.0;  ///< fixed: of the whole; offset: added
  int index = 0;            ///< slice: which of the slices' powers, from 0
  Unknown unknown{};
  bool operator==(const Depth&) const = default;
};

struct Surface {
  std::string name;
  MeshSource mesh;
  Placement placement;
  double scale = 1.0;
  double illumination = 0.0;  ///< 0..1
  Albedo albedo{};
  std::string group;
  bool hidden = false;
  bool locked = false;
  Unknown unknown{};
  bool operator==(const Surface&) const = default;
};

struct Object {
  std::string name;
  MeshSource mesh;
  Placement placement;
  double scale = 1.0;
  Appearance appearance;
  Unknown appearance_unknown{};  ///< beside "unlit", "checker" or "image"
  Depth depth;
  std::string group;
  bool hidden = false;
  bool locked = false;
  Unknown unknown{};
  bool operator==(const Object&) const = default;
};

enum class LightKind { sun, point, sky };

struct Light {
  std::string name;
  LightKind kind = LightKind::sun;
  glm::dvec3 position_m{0.0};            ///< point
  glm::dvec3 direction{0.0, -1.0, 0.0};  ///< sun: the way the light travels
  glm::dvec3 color{1.0};                 ///< linear RGB
  double intensity = 1.0;                ///< sun and sky: on a surface facing it; point: at 1 m
  Unknown unknown{};
  bool operator==(const Light&) const = default;
};

struct Cue {
  std::string name;
  double time_s = 0.0;
  Unknown unknown{};
  bool operator==(const Cue&) const = default;
};

/// Everything a designer has said. An immutable snapshot: change it with `apply` (core/scene/edit.h).
struct Project {
  std::string name;
  Viewer viewer;
  Glasses glasses;
  Sweep sweep;
  std::vector<Projector> projectors;
  Slices slices;
  Frames frames;
  std::vector<Surface> surfaces;
  std::vector<Object> objects;
  std::vector<Light> lights;
  std::vector<Cue> cues;
  double ambient_lux = 0.0;  ///< the room's own light on every surface, all the time
  Unknown unknown{};
  bool operator==(const Project&) const = default;
};

}  // namespace focalstage
