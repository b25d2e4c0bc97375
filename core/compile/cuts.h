#pragma once

#include <cstdint>
#include <functional>

#include "core/compile/eye_view.h"
#include "core/compile/kernel.h"

namespace focalstage {

// What a texture's alpha cuts away. The kernel knows triangles alone; where what it met is cut away there, the look
// goes on to what lies behind, by the kernel's own arithmetic. Where nothing is cut nothing of this is asked.

/// Whether triangle `index` of a view is cut away where the look (x, y) meets it.
using IsCut = std::function<bool(std::uint32_t index, double x, double y)>;

/// Lets looks through what is cut away in `nearest`, which the kernel made of the same view and looks.
void pass_cuts(const KernelView& view, const TileLooks& looks, double origin_x, double origin_y, const IsCut& is_cut,
               TileNearest& nearest);

/// The same for the objects of an eye; nothing to do where none of them is cut.
void pass_cuts(const EyeView& view, const TileLooks& looks, double origin_x, double origin_y, TileNearest& nearest);

}  // namespace focalstage
