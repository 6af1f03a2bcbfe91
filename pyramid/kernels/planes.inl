// Planes of colour segments at the holes of a row, one lane per hole.

namespace pomona {
namespace {

/// The planes of each lane's segment.
struct LanePlanes {
  Floats a, b, c, low, high;
  Ints x0, y0;

  LanePlanes(const SegmentPlane* planes, Ints segment) {
    static_assert(sizeof(SegmentPlane) == 8 * sizeof(float));
    if (!anyOf(segment != segment[0])) {  // most often: gathering takes longer than all the rest
      const SegmentPlane& plane = planes[segment[0]];
      a = broadcast(plane.a), b = broadcast(plane.b), c = broadcast(plane.c);
      low = broadcast(plane.low), high = broadcast(plane.high);
      x0 = Ints{} + plane.x0, y0 = Ints{} + plane.y0;
      return;
    }
    const auto word = [&](int i) { return gather(reinterpret_cast<const float*>(planes) + i, segment * 8); };
    a = floatsOf(word(0)), b = floatsOf(word(1)), c = floatsOf(word(2));
    low = floatsOf(word(3)), high = floatsOf(word(4));
    x0 = word(5), y0 = word(6);
  }
  /// Not kept within low and high.
  Floats at(Ints x, std::int32_t y) const {
    return a * __builtin_convertvector(x - x0, Floats) + b * __builtin_convertvector(y - y0, Floats) + c;
  }
};

/// Lanes at whose place the right view sees something behind `e`; see wouldHideFromRight() in
/// pyramid/holes.h.
inline Ints hidesFromRight(const PlaneFillRow& row, Ints x, Floats e) {
  const Floats last = broadcast(static_cast<float>(row.width));
  // floor(), with what is beyond the image drawn to its very edge so that it fits an integer
  const Floats place = min(max(__builtin_convertvector(x, Floats) - e + 0.5f, broadcast(-1.0f)), last);
  const Ints truncated = __builtin_convertvector(place, Ints);
  const Ints column = truncated + (__builtin_convertvector(truncated, Floats) > place);
  const Ints inside = (column >= 0) & (column < row.width);
  const Floats seen = floatsOf(gather(row.right_disparity, column & inside));
  return inside & (seen < e - row.visibility_tolerance_px);
}

void planeDisparities(const PlaneFillRow& row, const std::int32_t* x, const std::int32_t* segment, int n,
                      float* out) {
  const Floats unknown = broadcast(__builtin_nanf(""));
  for (int i = 0; i < n; i += kFloatLanes) {
    const Ints columns = load(x + i);
    const LanePlanes planes(row.planes, load(segment + i));
    Floats e = planes.at(columns, row.y);
    e = e < planes.low ? planes.low : e;
    e = e > planes.high ? planes.high : e;
    const Ints before = columns < row.left_x;
    const Ints behind = columns > row.right_x;
    const Ints border_x = before ? Ints{} + row.left_x : Ints{} + row.right_x;
    const Floats border = before ? broadcast(row.beyond_left_px) : broadcast(row.beyond_right_px);
    const Floats off = planes.at(border_x, row.y) - border;
    const Ints stays = (off < row.border_tolerance_px) & (off > -row.border_tolerance_px);
    const Ints possible = (e >= row.min_disparity) & (e <= row.max_disparity) & (stays | ~(before | behind)) &
                          ~hidesFromRight(row, columns, e);
    store(out + i, possible ? e : unknown);
  }
}

}  // namespace
}  // namespace pomona
