// SPDX-License-Identifier: GPL-3.0-or-later
// Where the cell list was before it moved to core; goes once no include names it.
#pragma once

#include "core/point_grid.hpp"
