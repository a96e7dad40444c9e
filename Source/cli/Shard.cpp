#include "cli/Shard.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace pacini::cli
{

std::string nameOf(const Shard& shard)
{
    return fmt::format("{}/{}", shard.number, shard.count);
}

Result<Shard> parseShard(std::string_view text)
{
    const std::size_t slash = text.find('/');
    const auto number = parseNumber<unsigned>(text.substr(0, slash));
    const auto count = slash == std::string_view::npos ? std::nullopt : parseNumber<unsigned>(text.substr(slash + 1));
    if (!number || !count || *number < 1 || *number > *count || *count > mostShards)
        return Error{ErrorCode::invalidArgument, "--shard",
                     fmt::format("'{}' is not a shard such as 1/8 to 8/8", text)};
    return Shard{*number, *count};
}

std::vector<bool> filesOfShard(const std::vector<std::uint64_t>& sizes, Shard shard)
{
    std::vector<std::size_t> largestFirst(sizes.size());
    std::iota(largestFirst.begin(), largestFirst.end(), std::size_t(0));
    std::stable_sort(largestFirst.begin(), largestFirst.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    using Load = std::pair<std::uint64_t, unsigned>; // with the number of the shard, so that equal ones have an order
    std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
    for (unsigned number = 1; number <= shard.count; ++number)
        loads.emplace(0, number);
    constexpr std::uint64_t work = 4096; // of a file without content: opening and writing take time too
    std::vector<bool> chosen(sizes.size(), false);
    for (const std::size_t file : largestFirst)
    {
        auto [load, number] = loads.top();
        loads.pop();
        chosen[file] = number == shard.number;
        loads.emplace(load + sizes[file] + work, number);
    }
    return chosen;
}

} // namespace pacini::cli
