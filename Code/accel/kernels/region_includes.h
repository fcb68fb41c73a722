// What the code that is compiled for several sets of instructions needs: it is included inside a
// region of target.h, and headers have to come in front of that.
#pragma once

#include "accel/kernels/exact_hit.h"
#include "accel/kernels/pause.h"
#include "accel/triangle.h"
#include "base/prefetch.h"
#include "base/target.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <immintrin.h>
#include <limits>
#include <new>
