#pragma once

// Names of the kinds of lanes, in projects and in Python.

#include "io/Fields.h"

#include <pacini/clip/edits/Lane.h>

#include <array>

namespace pacini
{

inline constexpr std::array<Choice<LaneKind>, 5> laneKinds{{{"envelope", LaneKind::envelope},
                                                            {"centroid", LaneKind::centroid},
                                                            {"amplitude", LaneKind::amplitude},
                                                            {"pitch", LaneKind::pitch},
                                                            {"noise", LaneKind::noise}}};

} // namespace pacini
