#pragma once

// Pinned numbers: results that no theory gives (of a fit, a design, a chain of blocks) as they were when somebody last
// looked at them, in `Tests/pinned/ROOM.txt`, a line each. They tell that a result has changed, not that it was right:
// what has an analytic result, a SciPy vector or a property is tested by that. After a meant change they are made anew
// by `PACINI_PIN=1 build/release/bin/pacini_tests "NAMES OF TESTS"`, and the commit says why they moved.

#include <pacini/clip/Curve.h>

#include <initializer_list>
#include <span>
#include <string>

namespace pacini
{

// Checks `values` against the line `name` ("linearize/equalizer fit, stiff") of the pinned numbers, each within
// `tolerance` of its magnitude (at least of 1e-4 of the largest of the line). More than 24 values are kept as their
// count, sum of squares, largest magnitude and three weighted sums, in which each value counts.
void checkPinned(const std::string& name, std::span<const double> values, double tolerance = 1e-7);

inline void checkPinned(const std::string& name, std::initializer_list<double> values, double tolerance = 1e-7)
{
    checkPinned(name, std::span<const double>(values.begin(), values.size()), tolerance);
}

// The same within 1e-5, and of long lists the first and the last twelve values by themselves, within 1e-4.
void checkPinnedWithEnds(const std::string& name, std::span<const double> values);

// Checks the times of a curve within 1e-6 as line `name`, times of `of`, and its values within `tolerance`.
void checkPinnedCurve(const std::string& name, const std::string& of, const Curve& curve, double tolerance = 1e-6);

} // namespace pacini
