// Compiled twice, under two names and for two instruction sets, with vectors as long as each has registers for (a
// compiler takes comparisons of longer ones apart, element by element); see kernel.h. Nothing from the standard library
// may be instantiated here: the linker could pick the copy made for the larger instruction set for everyone.

namespace focalstage {
namespace {

constexpr int lanes = FOCALSTAGE_LANES;
constexpr int half = lanes / 2;

using Floats = float __attribute__((vector_size(4 * lanes)));
using Ints = std::int32_t __attribute__((vector_size(4 * lanes)));
using Doubles = double __attribute__((vector_size(8 * half)));
using HalfFloats = float __attribute__((vector_size(4 * half)));
using HalfInts = std::int32_t __attribute__((vector_size(4 * half)));
using FourDoubles = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));

Floats load(const float* from) { return *reinterpret_cast<const Floats*>(from); }
Ints load(const std::int32_t* from) { return *reinterpret_cast<const Ints*>(from); }
void store(float* to, Floats value) { *reinterpret_cast<Floats*>(to) = value; }
void store(std::int32_t* to, Ints value) { *reinterpret_cast<Ints*>(to) = value; }

/// st - 1 with st the stretch of looks through the lens: c d / (d + d_e - c d) with c = power * d_e.
Floats stretch_less_one(Floats surface_m, float bend, float lens_to_pupil_m) {
  const Floats bent = bend * surface_m;
  return bent / (surface_m + lens_to_pupil_m - bent);
}

constexpr Box nothing{__builtin_inff(), __builtin_inff(), -__builtin_inff(), -__builtin_inff()};

/// Bounds of one row. A NaN never compares, so samples that see nothing do not count.
void bound_row(TileLooks& looks, int row) {
  const float* const x = looks.x + row * tile_side;
  const float* const y = looks.y + row * tile_side;
  Box box = nothing;
  for (int i = 0; i < tile_side; ++i) {
    box.min_x = x[i] < box.min_x ? x[i] : box.min_x;
    box.max_x = x[i] > box.max_x ? x[i] : box.max_x;
    box.min_y = y[i] < box.min_y ? y[i] : box.min_y;
    box.max_y = y[i] > box.max_y ? y[i] : box.max_y;
  }
  looks.row_min_x[row] = box.min_x;
  looks.row_min_y[row] = box.min_y;
  looks.row_max_x[row] = box.max_x;
  looks.row_max_y[row] = box.max_y;
}

void place(const TileHits& hits, double origin_x, double origin_y, float bend, float lens_to_pupil_m, TileLooks& out) {
  const float ox = static_cast<float>(origin_x);
  const float oy = static_cast<float>(origin_y);
  Box all = nothing;
  for (int row = 0; row < tile_side; ++row) {
    for (int at = row * tile_side; at < (row + 1) * tile_side; at += lanes) {
      const Floats x = load(hits.x + at);
      const Floats y = load(hits.y + at);
      const Floats stretch = stretch_less_one(load(hits.surface_m + at), bend, lens_to_pupil_m);
      store(out.x + at, x + (ox + x) * stretch);
      store(out.y + at, y + (oy + y) * stretch);
    }
    bound_row(out, row);
    if (out.row_min_x[row] < all.min_x) all.min_x = out.row_min_x[row];
    if (out.row_min_y[row] < all.min_y) all.min_y = out.row_min_y[row];
    if (out.row_max_x[row] > all.max_x) all.max_x = out.row_max_x[row];
    if (out.row_max_y[row] > all.max_y) all.max_y = out.row_max_y[row];
  }
  // Back to the tangent plane, wide enough for the rounding of triangles' boxes.
  const float slack = 1e-6f * (1.0f + __builtin_fabsf(ox) + __builtin_fabsf(oy));
  out.all = {ox + all.min_x - slack, oy + all.min_y - slack, ox + all.max_x + slack, oy + all.max_y + slack};
}

bool apart(const Box& a, const Box& b) {
  return !(a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y);
}

alignas(32) constexpr std::int32_t bit_of_row[tile_side] = {1, 2, 4, 8, 16, 32, 64, 128};

/// The rows of a tile whose bounds meet a box, as a bit each.
unsigned rows_touched(const TileLooks& looks, const Box& box) {
  using Words = std::int64_t __attribute__((vector_size(4 * lanes)));
  std::int64_t bits = 0;
  for (int first = 0; first < tile_side; first += lanes) {
    const Ints touched = (load(looks.row_min_x + first) <= box.max_x) & (load(looks.row_max_x + first) >= box.min_x) &
                         (load(looks.row_min_y + first) <= box.max_y) & (load(looks.row_max_y + first) >= box.min_y);
    const Words words = reinterpret_cast<Words>(touched & load(bit_of_row + first));
    for (int i = 0; i < half; ++i) bits |= words[i];
  }
  return static_cast<unsigned>(bits | bits >> 32) & 0xffu;
}

/// What stays the same for all triangles of a tile.
struct Tile {
  double origin_x, origin_y;
  float x, y, slack;
  float highest;  ///< inverse depths above are too near to be seen
};

void cover_one(const ViewTriangle& triangle, const Box& bounds, std::int32_t index, const TileLooks& looks,
               const Tile& tile, TileNearest& out) {
  const Box box{bounds.min_x - tile.x - tile.slack, bounds.min_y - tile.y - tile.slack,
                bounds.max_x - tile.x + tile.slack, bounds.max_y - tile.y + tile.slack};
  unsigned rows = rows_touched(looks, box);
  if (rows == 0) return;
  // Moved to the tile's origin in double, so that single precision holds the small rest.
  const FourDoubles& a = *reinterpret_cast<const FourDoubles*>(triangle.a);
  const FourDoubles& b = *reinterpret_cast<const FourDoubles*>(triangle.b);
  const FourDoubles& c = *reinterpret_cast<const FourDoubles*>(triangle.c);
  const FourFloats per_x = __builtin_convertvector(a, FourFloats);
  const FourFloats per_y = __builtin_convertvector(b, FourFloats);
  const FourFloats rest = __builtin_convertvector(a * tile.origin_x + b * tile.origin_y + c, FourFloats);
  for (; rows != 0; rows &= rows - 1) {
    const int row = __builtin_ctz(rows) * tile_side;
    for (int first = row; first < row + tile_side; first += lanes) {
      const Floats x = load(looks.x + first);
      const Floats y = load(looks.y + first);
      const Ints inside = (per_x[0] * x + per_y[0] * y + rest[0] >= 0.0f) &
                          (per_x[1] * x + per_y[1] * y + rest[1] >= 0.0f) &
                          (per_x[2] * x + per_y[2] * y + rest[2] >= 0.0f);
      const Floats r = per_x[3] * x + per_y[3] * y + rest[3];
      const Floats best = load(out.inverse_m + first);
      const Ints nearer = inside & (r > best) & (r <= tile.highest);
      store(out.inverse_m + first, nearer ? r : best);
      store(out.triangle + first, nearer ? Ints{} + index : load(out.triangle + first));
    }
  }
}

void cover(const KernelView& view, const TileLooks& looks, double origin_x, double origin_y, TileNearest& out) {
  for (int first = 0; first < tile_samples; first += lanes) {
    store(out.inverse_m + first, Floats{});
    store(out.triangle + first, Ints{} - 1);
  }
  if (!(looks.all.min_x <= looks.all.max_x)) return;
  const CellGrid& grid = view.grid;
  const float x = static_cast<float>(origin_x);
  const float y = static_cast<float>(origin_y);
  const Tile tile{
      origin_x, origin_y, x, y, 1e-6f * (1.0f + __builtin_fabsf(x) + __builtin_fabsf(y)), 1.0f / view.nearest_m};
  const int first_column = column_of(grid, looks.all.min_x);
  const int last_column = column_of(grid, looks.all.max_x);
  const int first_row = row_of(grid, looks.all.min_y);
  const int last_row = row_of(grid, looks.all.max_y);
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const std::uint32_t* const begin = view.begin + (row * grid.columns + column);
      for (std::uint32_t i = begin[0]; i < begin[1]; ++i) {
        const std::uint32_t index = view.items[i];
        const Box& box = view.bounds[index].box;
        if (apart(box, looks.all)) continue;
        // A triangle in several cells is taken in the first of them that the tile visits.
        if (column != first_column && column_of(grid, box.min_x) != column) continue;
        if (row != first_row && row_of(grid, box.min_y) != row) continue;
        cover_one(view.triangles[index], box, static_cast<std::int32_t>(index), looks, tile, out);
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

Ints less(Ints a, Ints b) { return a < b ? a : b; }
Ints more(Ints a, Ints b) { return a > b ? a : b; }
Floats less(Floats a, Floats b) { return a < b ? a : b; }
Floats more(Floats a, Floats b) { return a > b ? a : b; }

TileLit lit(const TileNearest& nearest, const TileWeights& weights) {
  constexpr std::int32_t most = 0x7fffffff;
  Ints count{};
  Ints lowest = Ints{} + most;
  Ints highest = Ints{} - 1;
  Floats lowest_d = Floats{} + __builtin_inff();
  Floats highest_d = Floats{} - __builtin_inff();
  for (int first = 0; first < tile_samples; first += lanes) {
    const Ints shown = load(weights.weight + first) > 0.0f;
    const Ints index = load(nearest.triangle + first);
    const Floats wanted_d = load(weights.wanted_d + first);
    count -= shown;  // true is -1
    lowest = shown ? less(lowest, index) : lowest;
    highest = shown ? more(highest, index) : highest;
    lowest_d = shown ? less(lowest_d, wanted_d) : lowest_d;
    highest_d = shown ? more(highest_d, wanted_d) : highest_d;
  }
  TileLit all{count[0], lowest[0], highest[0], lowest_d[0], highest_d[0]};
  for (int i = 1; i < lanes; ++i) {
    all.count += count[i];
    if (lowest[i] < all.lowest_triangle) all.lowest_triangle = lowest[i];
    if (highest[i] > all.highest_triangle) all.highest_triangle = highest[i];
    if (lowest_d[i] < all.lowest_d) all.lowest_d = lowest_d[i];
    if (highest_d[i] > all.highest_d) all.highest_d = highest_d[i];
  }
  return all;
}

void add_even(const TileWeights& weights, float share, float level, float* light) {
  for (int first = 0; first < tile_samples; first += lanes) {
    store(light + first, load(light + first) + load(weights.weight + first) * share * level);
  }
}

/// The largest whole number not above each value. What lies beyond a thousand million, or is no number, belongs to looks
/// that meet nothing: it becomes any number that an int holds.
HalfInts whole(Doubles any) {
  const Doubles most = Doubles{} + 1e9;
  const Doubles below = any < most ? any : most;
  const Doubles value = below > -most ? below : -most;
  const HalfInts towards_zero = __builtin_convertvector(value, HalfInts);
  return towards_zero + __builtin_convertvector(value < __builtin_convertvector(towards_zero, Doubles), HalfInts);
}

void add_checker(const CheckerPlanes& planes, const TileLooks& looks, double origin_x, double origin_y,
                 const TileWeights& weights, float share, float a, float b, float* light) {
  for (int first = 0; first < tile_samples; first += half) {
    const HalfFloats local_x = *reinterpret_cast<const HalfFloats*>(looks.x + first);
    const HalfFloats local_y = *reinterpret_cast<const HalfFloats*>(looks.y + first);
    const Doubles x = __builtin_convertvector(local_x, Doubles) + origin_x;
    const Doubles y = __builtin_convertvector(local_y, Doubles) + origin_y;
    const Doubles per = 1.0 / (planes.common[0] * x + planes.common[1] * y + planes.common[2]);
    const HalfInts column = whole((planes.u[0] * x + planes.u[1] * y + planes.u[2]) * per);
    const HalfInts row = whole((planes.v[0] * x + planes.v[1] * y + planes.v[2]) * per);
    const HalfInts odd = ((column ^ row) & 1) != 0;
    const HalfFloats weight = *reinterpret_cast<const HalfFloats*>(weights.weight + first);
    const HalfFloats level = odd ? HalfFloats{} + b : HalfFloats{} + a;
    const HalfFloats added =
        weight > 0.0f ? weight * share * level : HalfFloats{};  // elsewhere a look may meet nothing
    HalfFloats* const sum = reinterpret_cast<HalfFloats*>(light + first);
    *sum = *sum + added;
  }
}

using LooseFloats = float __attribute__((vector_size(4 * lanes), aligned(4)));

void spread(const float* from, int stride, int way, const float* shares, int width, int height, float sign,
            float* sums) {
  constexpr int rows = lanes;  // as many at a time as there are registers, for sums that do not wait for each other
  constexpr int parts = tile_side / lanes;
  for (int first = 0; first < tile_side; first += rows) {
    Floats sum[rows][parts] = {};
    const float* share = shares;
    for (int j = 0; j < height; ++j) {
      const float* const line = from + (first + way * j) * stride;
      for (int i = 0; i < width; ++i, ++share) {
        if (*share == 0.0f) continue;
        const Floats each = Floats{} + *share;
        const float* const values = line + way * i;
        for (int y = 0; y < rows; ++y) {
          for (int part = 0; part < parts; ++part) {
            sum[y][part] += each * *reinterpret_cast<const LooseFloats*>(values + y * stride + part * lanes);
          }
        }
      }
    }
    for (int y = 0; y < rows; ++y) {
      for (int part = 0; part < parts; ++part) {
        LooseFloats& to = *reinterpret_cast<LooseFloats*>(sums + (first + y) * tile_side + part * lanes);
        to += sign * sum[y][part];
      }
    }
  }
}

}  // namespace

const Kernel FOCALSTAGE_KERNEL{place, cover, weigh, lit, add_even, add_checker, spread};

}  // namespace focalstage
