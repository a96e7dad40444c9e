#pragma once

// One place that knows which Catch2 it is: 2.13 (Debian 12) or 3.x.

#if defined(PACINI_CATCH_3)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
