#pragma once

// Free descriptions: words, their counts and their categories.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::study
{

/// A description of a stimulus.
struct Description
{
    std::string group;
    std::string participant;
    std::string stimulus;
    std::string words;
};

/// The words of a text: in small letters, without punctuation and numbers, without words that say nothing (German and
/// English: und, the).
[[nodiscard]] std::vector<std::string> wordsOf(std::string_view text);

/// Words of each category. A word that ends in * matches all words with this beginning.
class WordCategories
{
public:
    /// Reads a table with lines `category,word`; the first line may be a heading; UTF-8, or else Latin-1. Errors
    /// (invalidData) at `line 3`.
    [[nodiscard]] static Result<WordCategories> ofCsv(std::string_view bytes);

    /// Empty for none. Of beginnings the longest counts.
    [[nodiscard]] std::string categoryOf(std::string_view word) const;

    /// The categories in the order of the table.
    [[nodiscard]] const std::vector<std::string>& names() const noexcept { return ordered; }

private:
    std::map<std::string, std::string, std::less<>> whole, beginnings;
    std::vector<std::string> ordered;
};

/// Count of each word, the most frequent first.
using WordCounts = std::vector<std::pair<std::string, std::size_t>>;
[[nodiscard]] WordCounts countWords(const std::vector<Description>& descriptions, std::string_view group);

} // namespace pacini::study
