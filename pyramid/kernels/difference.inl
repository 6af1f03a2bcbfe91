// What several of the bodies count in.

namespace pomona {
namespace {

inline int absoluteDifference(int a, int b) {
  return a > b ? a - b : b - a;
}

}  // namespace
}  // namespace pomona
