#include "study/Words.h"

#include "io/TextLines.h"
#include "io/TextMark.h"
#include "io/Utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

namespace pacini::study
{

namespace
{
// Articles, pronouns, prepositions, conjunctions and forms of to be and to have: what is said around what is felt.
constexpr std::array<std::string_view, 113> emptyWords{
    "a",     "aber",  "als",       "am",    "an",     "and",    "are",    "as",    "at",   "auch", "auf",   "aus",
    "be",    "bei",   "bin",       "but",   "by",     "da",     "dann",   "das",   "dass", "dem",  "den",   "der",
    "des",   "die",   "dies",      "diese", "dieser", "dieses", "doch",   "durch", "ein",  "eine", "einem", "einen",
    "einer", "eines", "er",        "es",    "etwas",  "for",    "from",   "für",   "had",  "has",  "hat",   "have",
    "ich",   "ihr",   "im",        "in",    "into",   "is",     "ist",    "it",    "its",  "ja",   "kann",  "kein",
    "keine", "like",  "man",       "me",    "mein",   "meine",  "mich",   "mir",   "mit",  "my",   "nach",  "nicht",
    "noch",  "not",   "nur",       "oder",  "of",     "on",     "or",     "sehr",  "sein", "sich", "sie",   "sind",
    "so",    "some",  "something", "that",  "the",    "then",   "there",  "this",  "to",   "um",   "und",   "very",
    "vom",   "von",   "vor",       "war",   "was",    "wenn",   "werden", "wie",   "wird", "with", "wurde", "you",
    "zu",    "zum",   "zur",       "über",  "unter"};

/// One letter of Latin script in its small form; what is no letter becomes nothing.
std::optional<std::string> smallLetter(std::string_view letter)
{
    const auto byte = [&](std::size_t i)
    {
        return static_cast<unsigned char>(letter[i]);
    };
    if (letter.size() == 1)
    {
        if (std::isalpha(byte(0)) == 0)
            return std::nullopt;
        return std::string(1, static_cast<char>(std::tolower(byte(0))));
    }
    // U+00C0 to U+00DE are the capitals of U+00E0 to U+00FE; between them the sign of multiplication.
    if (letter.size() == 2 && byte(0) == 0xC3 && byte(1) >= 0x80 && byte(1) <= 0x9E && byte(1) != 0x97)
        return std::string{letter[0], static_cast<char>(byte(1) + 0x20)};
    // General punctuation: quotation marks, dashes, the ellipsis.
    if (letter.size() == 3 && byte(0) == 0xE2 && byte(1) == 0x80)
        return std::nullopt;
    if (letter.size() == 2 && byte(0) == 0xC2)
        return std::nullopt;
    return std::string(letter);
}

/// Bytes of the character at `at`; one of what is none.
std::size_t lengthOfLetter(std::string_view text, std::size_t at)
{
    return std::max<std::size_t>(firstUtf8(text.substr(at)).bytes, 1);
}
} // namespace

std::vector<std::string> wordsOf(std::string_view given)
{
    const std::string text = wellFormedUtf8(std::string(given));
    std::vector<std::string> words;
    std::string word;
    const auto end = [&]
    {
        if (!word.empty() && std::find(emptyWords.begin(), emptyWords.end(), word) == emptyWords.end())
            words.push_back(word);
        word.clear();
    };
    for (std::size_t i = 0; i < text.size();)
    {
        const std::size_t length = lengthOfLetter(text, i);
        if (const auto letter = smallLetter(std::string_view(text).substr(i, length)))
            word += *letter;
        else if (text[i] == '-' && !word.empty() && i + 1 < text.size() &&
                 smallLetter(std::string_view(text).substr(i + 1, 1)))
            word += '-';
        else
            end();
        i += length;
    }
    end();
    return words;
}

Result<WordCategories> WordCategories::ofCsv(std::string_view bytes)
{
    const auto unmarked = utf8Text(bytes);
    if (!unmarked)
        return unmarked.error();
    const std::string decoded = isUtf8(*unmarked) ? std::string(*unmarked) : utf8OfWindows1252(*unmarked);
    std::string_view text = decoded;
    WordCategories categories;
    const std::size_t first = takeSeparatorLine(text) ? 2 : 1;
    std::size_t number = first - 1;
    while (!text.empty())
    {
        ++number;
        const std::string_view line = takeLine(text);
        if (line.empty() ||
            (number == first && (line == "category,word" || line == "category;word" || line == "category\tword")))
            continue;
        const std::size_t comma = line.find_first_of(",;\t");
        if (comma == std::string_view::npos || comma == 0 || comma + 1 == line.size())
            return Error{ErrorCode::invalidData, fmt::format("line {}", number),
                         "is not a category and a word with a comma between"};
        const std::string category(line.substr(0, comma));
        std::string word;
        for (const char c : line.substr(comma + 1))
            word += c;
        const bool begins = word.ends_with('*');
        if (begins)
            word.pop_back();
        std::string small;
        for (std::size_t i = 0; i < word.size();)
        {
            const std::size_t length = lengthOfLetter(word, i);
            const std::string_view letter = std::string_view(word).substr(i, length);
            small += smallLetter(letter).value_or(std::string(letter));
            i += length;
        }
        (begins ? categories.beginnings : categories.whole).insert_or_assign(small, category);
        if (std::find(categories.ordered.begin(), categories.ordered.end(), category) == categories.ordered.end())
            categories.ordered.push_back(category);
    }
    if (categories.ordered.empty())
        return Error{ErrorCode::invalidData, "", "has no category"};
    return categories;
}

std::string WordCategories::categoryOf(std::string_view word) const
{
    if (const auto found = whole.find(word); found != whole.end())
        return found->second;
    for (std::size_t length = word.size(); length > 0; --length)
        if (const auto found = beginnings.find(word.substr(0, length)); found != beginnings.end())
            return found->second;
    return {};
}

WordCounts countWords(const std::vector<Description>& descriptions, std::string_view group)
{
    std::map<std::string, std::size_t> counts;
    for (const Description& one : descriptions)
        if (one.group == group)
            for (const std::string& word : wordsOf(one.words))
                ++counts[word];
    WordCounts sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    return sorted;
}

} // namespace pacini::study
