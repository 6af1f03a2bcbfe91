#include "bench/sparse/tables.h"

namespace pomona {

void writeSobelSiftTable(std::ostream&, const SparseTableOptions&) {}

}  // namespace pomona
