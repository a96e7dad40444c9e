#pragma once

// Shards: parts of a list of files, each processed by one of several runs, possibly on several machines.

#include <pacini/foundation/Result.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::cli
{

/// Part `number` of `count`, from 1.
struct Shard
{
    unsigned number = 1;
    unsigned count = 1;
    bool operator==(const Shard&) const = default;
};

inline constexpr unsigned mostShards = 1'000'000;

/// Such as "2/8".
[[nodiscard]] std::string nameOf(const Shard& shard);

/// The shard that "2/8" names. Errors: invalidArgument.
[[nodiscard]] Result<Shard> parseShard(std::string_view text);

/// Returns for each of the files, in their order, whether it is in the shard. Files are divided by size, largest first;
/// each goes to the shard with the smallest sum so far (R. L. Graham, "Bounds on Multiprocessing Timing Anomalies",
/// 1969: the fullest shard is at most 4/3 of the optimum). The same sizes in the same order give the same shards on
/// every machine; each file is in exactly one of them.
[[nodiscard]] std::vector<bool> filesOfShard(const std::vector<std::uint64_t>& sizes, Shard shard);

} // namespace pacini::cli
