#pragma once

#include <string>

#include <doctest/doctest.h>

#include "core/scene/value.h"
#include "io/json/json.h"

namespace focalstage {

/// A project that uses every key of the file at least once.
inline constexpr const char* full_sample = R"({
  "focalstage": 1,
  "name": "Everything",
  "viewer": { "position_m": [0, 0, 0], "rotation_xyzw": [0, 0, 0, 1], "interpupillary_mm": 63,
              "keys": [ { "time_s": 0, "position_m": [0, 0, 0], "rotation_xyzw": [0, 0, 0, 1] },
                        { "time_s": 1, "position_m": [0.1, 0, 0], "rotation_xyzw": [0, 0, 0, 1] } ],
              "track": "head" },
  "glasses": { "lens_to_pupil_mm": 15, "lens_range_d": [-10, 10], "lens_aperture_mm": 16,
               "shutter_close_ms": 0.1, "shutter_open_ms": 3,
               "lens_response": { "left": [ { "harmonic": 1, "gain_d_per_a": 39, "phase_deg": -5 } ],
                                  "right": [ { "harmonic": 1, "gain_d_per_a": 41, "phase_deg": -6 } ] },
               "lens_limits": { "max_current_a": 0.25, "max_rms_current_a": 0.2, "max_frequency_hz": 900 } },
  "sweep": { "frequency_hz": 60, "min_power_d": -1.5, "max_power_d": 1.5,
             "waveform": { "left": { "power_d": [-1, 0, 1, 2, 3, 2, 1, 0], "drive_a": [0, 1, 2, 3, 4, 5, 6, 7] },
                           "right": { "power_d": [-2, 0, 1, 2, 3, 2, 1, 0], "drive_a": [0, 1, 2, 3, 4, 5, 6, 8] } } },
  "projectors": [ { "name": "main", "model": "dynaflash", "width_px": 1024, "height_px": 768, "pixel_layout": "diamond",
                    "frames_per_second": 2000, "bits": 8, "color": "gray", "latency_ms": 0.15, "gamma": 1,
                    "transfer": [0, 0.25, 1], "black_level": 0.01,
                    "fx_px": 1400, "fy_px": 1400, "cx_px": 512, "cy_px": 384, "distortion": [0.1, 0, 0, 0, 0],
                    "position_m": [0, 0.3, 0], "rotation_xyzw": [0, 0, 0, 1],
                    "exposure_ms": 0.4, "focus_m": 0.5, "depth_of_field_d": 0.5, "lumens": 300,
                    "blend_margin_px": 48 } ],
  "slices": { "powers_d": [-1, 0, 1], "assignment": "linear", "breathing": "exact", "samples_per_pixel": 1,
              "compensation": { "mode": "albedo", "white": 0.5, "reference_m": 2 } },
  "frames": { "count": 2, "rate_hz": 30 },
  "surfaces": [
    { "name": "plane", "mesh": { "primitive": "plane", "size_m": [1.2, 0.8] }, "position_m": [0, 0, -0.5],
      "rotation_xyzw": [0, 0, 0, 1], "scale": 2, "illumination": 0.5, "albedo": [0.5, 0.25, 1],
      "keys": [ { "time_s": 0, "position_m": [0, 0, 0], "rotation_xyzw": [0, 0, 0, 1] } ],
      "track": "wand", "group": "walls", "hidden": true, "locked": true },
    { "name": "sphere", "mesh": { "primitive": "sphere", "radius_m": 0.2 }, "albedo": { "file": "assets/stone.jpg" } },
    { "name": "corner", "mesh": { "primitive": "corner", "size_m": [1, 1], "angle_deg": 90 }, "albedo": "material" },
    { "name": "step", "mesh": { "primitive": "step", "size_m": [1, 1], "depth_m": 0.1 } },
    { "name": "teapot", "mesh": { "primitive": "teapot" } },
    { "name": "scan", "mesh": { "file": "assets/wall.ply", "process": [ { "step": "flip" }, { "step": "weld", "tolerance_mm": 0.1 }, { "step": "drop-bits", "least_share": 0.02 },
        { "step": "fill-holes", "longest_mm": 50 }, { "step": "keep-part", "part": 1, "fold_deg": 20 },
        { "step": "decimate", "triangles": 1000 }, { "step": "smooth", "rounds": 5, "feature_deg": 40 },
        { "step": "subdivide", "scheme": "sqrt3", "rounds": 2 }, { "step": "decimate", "error_mm": 0.5 },
        { "step": "uv-plane", "position_m": [0, 1, 0], "rotation_xyzw": [0, 0, 0, 1], "size_m": [2, 1] },
        { "step": "uv-projector", "position_m": [0, 0, 1], "rotation_xyzw": [0, 0, 0, 1], "width_px": 640, "height_px": 480, "fx_px": 900, "fy_px": 901, "cx_px": 320, "cy_px": 240 } ] } } ],
  "objects": [
    { "name": "near", "mesh": { "file": "assets/rabbit.glb", "process": [ { "step": "flip" }, { "step": "weld", "tolerance_mm": 0.1 }, { "step": "drop-bits", "least_share": 0.02 },
        { "step": "fill-holes", "longest_mm": 50 }, { "step": "keep-part", "part": 1, "fold_deg": 20 },
        { "step": "decimate", "triangles": 1000 }, { "step": "smooth", "rounds": 5, "feature_deg": 40 },
        { "step": "subdivide", "scheme": "sqrt3", "rounds": 2 }, { "step": "decimate", "error_mm": 0.5 },
        { "step": "uv-plane", "position_m": [0, 1, 0], "rotation_xyzw": [0, 0, 0, 1], "size_m": [2, 1] },
        { "step": "uv-projector", "position_m": [0, 0, 1], "rotation_xyzw": [0, 0, 0, 1], "width_px": 640, "height_px": 480, "fx_px": 900, "fy_px": 901, "cx_px": 320, "cy_px": 240 } ] },
      "position_m": [0, 0, -0.333], "rotation_xyzw": [0, 0, 0, 1], "scale": 0.1,
      "appearance": { "checker": { "squares": [8, 4], "a": [1, 1, 1], "b": [0, 0, 0] } },
      "depth": { "mode": "fixed", "vergence_d": 3 },
      "keys": [ { "time_s": 0, "position_m": [0, 0, 0], "rotation_xyzw": [0, 0, 0, 1] } ],
      "track": "hand", "group": "animals", "hidden": true, "locked": true },
    { "name": "box", "mesh": { "primitive": "box", "size_m": [1, 2, 3] }, "appearance": { "unlit": [1, 0.5, 0] },
      "depth": { "mode": "slice", "index": 1 } },
    { "name": "plane", "mesh": { "primitive": "plane", "size_m": [1, 1] },
      "appearance": { "image": { "file": "frames/fire_####.png", "count": 48, "first": 0, "rate_hz": 24, "start_s": 0.5,
        "loop": "ping-pong", "wrap": "mirror", "filter": "nearest", "color_space": "linear", "lit": true,
        "alpha_cutoff": 0.5 } } },
    { "name": "sphere", "mesh": { "primitive": "sphere", "radius_m": 0.2 } },
    { "name": "corner", "mesh": { "primitive": "corner", "size_m": [1, 1], "angle_deg": 90 } },
    { "name": "step", "mesh": { "primitive": "step", "size_m": [1, 1], "depth_m": 0.1 } },
    { "name": "teapot", "mesh": { "primitive": "teapot" } } ],
  "lights": [ { "name": "lamp", "kind": "point", "position_m": [0, 2, 0], "direction": [0, -1, -1],
                "color": [1, 1, 0.9], "intensity": 0.7 } ],
  "cues": [ { "name": "start", "time_s": 0 }, { "name": "turn", "time_s": 0.5 } ],
  "ambient_lux": 20
})";

inline Value value_of(std::string_view json) {
  const auto value = parse_json(json, "test");
  REQUIRE_MESSAGE(value.ok(), std::string(json));
  return *value;
}

}  // namespace focalstage
