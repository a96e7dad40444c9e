#pragma once

// Lanes of an edit operation: visits those that it names.

#include "document/Edit.h"

#include <type_traits>
#include <variant>

namespace pacini
{

template <typename T>
inline constexpr bool hasScope = requires(T operation)
{
    operation.scope;
};

/// Calls visit(lane) for each lane that an operation names.
template <typename Operation, typename Visit>
void forNamedLanes(Operation& operation, Visit&& visit)
{
    std::visit(
        [&](auto& op)
        {
            using Op = std::decay_t<decltype(op)>;
            if constexpr (std::is_same_v<Op, LanePatch>)
                visit(op.lane);
            else if constexpr (hasScope<Op>)
                if (!op.scope.allLanes)
                    for (auto& lane : op.scope.lanes)
                        visit(lane);
        },
        operation);
}

/// The frequency that a lane has in a clip; 0 for those of the whole clip.
[[nodiscard]] double centreOf(const Clip& clip, Lane lane);

} // namespace pacini
