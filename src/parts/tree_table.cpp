// SPDX-License-Identifier: GPL-3.0-or-later
// Which copies of the tree's walks this processor runs.
#include "core/isa.hpp"
#include "parts/tree_isa.hpp"

namespace mortise {

namespace isa_baseline {
extern const TreeTable kTreeTable;
}
namespace isa_avx2 {
extern const TreeTable kTreeTable;
}
namespace isa_avx512 {
extern const TreeTable kTreeTable;
}

const TreeTable& tree_table() {
  return pick_isa(best_isa(), isa_baseline::kTreeTable, isa_avx2::kTreeTable,
                  isa_avx512::kTreeTable);
}

}  // namespace mortise
