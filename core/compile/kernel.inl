// Compiled twice, under two names and for two instruction sets; see kernel.h. Nothing from the standard library may be
// instantiated here: the linker could pick the copy made for the larger instruction set for everyone.

namespace focalstage {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));

constexpr int lanes = tile_side;

Floats load(const float* from) { return *reinterpret_cast<const Floats*>(from); }
Ints load(const std::int32_t* from) { return *reinterpret_cast<const Ints*>(from); }
void store(float* to, Floats value) { *reinterpret_cast<Floats*>(to) = value; }
void store(std::int32_t* to, Ints value) { *reinterpret_cast<Ints*>(to) = value; }

bool any(Ints mask) {
  using Words = std::int64_t __attribute__((vector_size(32)));
  const Words w = reinterpret_cast<Words>(mask);
  return (w[0] | w[1] | w[2] | w[3]) != 0;
}

/// st - 1 with st the stretch of looks through the lens: c d / (d + d_e - c d) with c = power * d_e.
Floats stretch_less_one(Floats surface_m, float bend, float lens_to_pupil_m) {
  const Floats bent = bend * surface_m;
  return bent / (surface_m + lens_to_pupil_m - bent);
}

void grow(Box& box, const float* x, const float* y) {
  for (int i = 0; i < lanes; ++i) {  // a NaN never compares, so samples that see nothing do not count
    if (x[i] < box.min_x) box.min_x = x[i];
    if (x[i] > box.max_x) box.max_x = x[i];
    if (y[i] < box.min_y) box.min_y = y[i];
    if (y[i] > box.max_y) box.max_y = y[i];
  }
}

constexpr Box nothing{__builtin_inff(), __builtin_inff(), -__builtin_inff(), -__builtin_inff()};

void place(const TileHits& hits, double origin_x, double origin_y, float bend, float lens_to_pupil_m, TileLooks& out) {
  const float ox = static_cast<float>(origin_x);
  const float oy = static_cast<float>(origin_y);
  Box all = nothing;
  for (int row = 0; row < tile_side; ++row) {
    const int at = row * lanes;
    const Floats x = load(hits.x + at);
    const Floats y = load(hits.y + at);
    const Floats stretch = stretch_less_one(load(hits.surface_m + at), bend, lens_to_pupil_m);
    store(out.x + at, x + (ox + x) * stretch);
    store(out.y + at, y + (oy + y) * stretch);
    out.row[row] = nothing;
    grow(out.row[row], out.x + at, out.y + at);
    const Box& box = out.row[row];
    if (box.min_x < all.min_x) all.min_x = box.min_x;
    if (box.min_y < all.min_y) all.min_y = box.min_y;
    if (box.max_x > all.max_x) all.max_x = box.max_x;
    if (box.max_y > all.max_y) all.max_y = box.max_y;
  }
  // Back to the tangent plane, wide enough for the rounding of triangles' boxes.
  const float slack = 1e-6f * (1.0f + __builtin_fabsf(ox) + __builtin_fabsf(oy));
  out.all = {ox + all.min_x - slack, oy + all.min_y - slack, ox + all.max_x + slack, oy + all.max_y + slack};
}

bool apart(const Box& a, const Box& b) {
  return !(a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y);
}

/// An affine function about the tile's origin: computed in double, so that single precision holds the small rest.
struct Local {
  float x, y, constant;
};

Local local(const Affine& f, double origin_x, double origin_y) {
  return {static_cast<float>(f.x), static_cast<float>(f.y),
          static_cast<float>(f.x * origin_x + f.y * origin_y + f.constant)};
}

Floats at(const Local& f, Floats x, Floats y) { return f.x * x + f.y * y + f.constant; }

void cover_one(const ViewTriangle& triangle, std::int32_t index, const TileLooks& looks, double origin_x,
               double origin_y, float highest, TileNearest& out) {
  const Local e0 = local(triangle.edge[0], origin_x, origin_y);
  const Local e1 = local(triangle.edge[1], origin_x, origin_y);
  const Local e2 = local(triangle.edge[2], origin_x, origin_y);
  const Local depth = local(triangle.inverse_depth, origin_x, origin_y);
  const float ox = static_cast<float>(origin_x);
  const float oy = static_cast<float>(origin_y);
  const float slack = 1e-6f * (1.0f + __builtin_fabsf(ox) + __builtin_fabsf(oy));
  const Box box{triangle.box.min_x - ox - slack, triangle.box.min_y - oy - slack, triangle.box.max_x - ox + slack,
                triangle.box.max_y - oy + slack};
  for (int row = 0; row < tile_side; ++row) {
    if (apart(box, looks.row[row])) continue;
    const int first = row * lanes;
    const Floats x = load(looks.x + first);
    const Floats y = load(looks.y + first);
    const Ints inside = (at(e0, x, y) >= 0.0f) & (at(e1, x, y) >= 0.0f) & (at(e2, x, y) >= 0.0f);
    const Floats r = at(depth, x, y);
    const Floats best = load(out.inverse_m + first);
    const Ints nearer = inside & (r > best) & (r <= highest);
    if (!any(nearer)) continue;
    store(out.inverse_m + first, nearer ? r : best);
    store(out.triangle + first, nearer ? Ints{} + index : load(out.triangle + first));
  }
}

void cover(const KernelView& view, const TileLooks& looks, double origin_x, double origin_y, TileNearest& out) {
  for (int first = 0; first < tile_samples; first += lanes) {
    store(out.inverse_m + first, Floats{});
    store(out.triangle + first, Ints{} - 1);
  }
  if (!(looks.all.min_x <= looks.all.max_x)) return;
  const CellGrid& grid = view.grid;
  const float highest = 1.0f / view.nearest_m;
  const int first_column = column_of(grid, looks.all.min_x);
  const int last_column = column_of(grid, looks.all.max_x);
  const int first_row = row_of(grid, looks.all.min_y);
  const int last_row = row_of(grid, looks.all.max_y);
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const std::uint32_t* const begin = view.begin + (row * grid.columns + column);
      for (std::uint32_t i = begin[0]; i < begin[1]; ++i) {
        const std::uint32_t index = view.items[i];
        const ViewTriangle& triangle = view.triangles[index];
        if (apart(triangle.box, looks.all)) continue;
        // A triangle in several cells is taken in the first of them that the tile visits.
        if (column != first_column && column_of(grid, triangle.box.min_x) != column) continue;
        if (row != first_row && row_of(grid, triangle.box.min_y) != row) continue;
        cover_one(triangle, static_cast<std::int32_t>(index), looks, origin_x, origin_y, highest, out);
      }
    }
  }
}

Floats clamped(Floats value) {
  const Floats low = value > 0.0f ? value : Floats{};
  return low < 1.0f ? low : Floats{} + 1.0f;
}

Floats band_weight(const SliceBand& band, Floats wanted_d) {
  if (band.nearest) {
    const Ints in = (wanted_d > band.from_d) & (wanted_d <= band.to_d);
    return in ? Floats{} + 1.0f : Floats{};
  }
  const Floats off_d = wanted_d - band.power_d;
  const Floats below = 1.0f + off_d * band.per_d_below;
  const Floats above = 1.0f - off_d * band.per_d_above;
  return clamped(below < above ? below : above);
}

void weigh(const TileHits& hits, const TileNearest& nearest, const TileWants& wants, const SliceBand& band, float bend,
           float lens_to_pupil_m, TileWeights& out) {
  const float per_lens = 1.0f / lens_to_pupil_m;
  for (int first = 0; first < tile_samples; first += lanes) {
    const Floats own = load(hits.inverse_m + first);
    const Floats stretch = stretch_less_one(load(hits.surface_m + first), bend, lens_to_pupil_m);
    const Floats on_plane = own + stretch * load(hits.slope + first);
    const Ints met = (on_plane > 0.0f) & (on_plane < per_lens);  // in front of the lens
    const Floats q = met ? on_plane : own;
    const Floats r = load(nearest.inverse_m + first);
    const Floats image_d = load(wants.gain + first) * (r / (1.0f - lens_to_pupil_m * r)) + load(wants.offset_d + first);
    const Floats wanted_d = q / (1.0f - lens_to_pupil_m * q) - image_d;
    store(out.wanted_d + first, wanted_d);
    store(out.weight + first, load(nearest.triangle + first) >= 0 ? band_weight(band, wanted_d) : Floats{});
  }
}

}  // namespace

const Kernel FOCALSTAGE_KERNEL{place, cover, weigh};

}  // namespace focalstage
