#pragma once

// What holds for the warnings of the readers of Pacini's own formats.

#include "FuzzCheck.h"
#include "io/ReadWarnings.h"

#include <string>

namespace pacini
{

/// Warnings are few and on one line each; a strict reader refuses just the texts that a lenient one warns of or
/// refuses.
inline void checkWarnings(const ReadWarnings& warnings, bool lenientReads, bool strictReads)
{
    const auto texts = warnings.texts();
    FUZZ_CHECK(texts.size() <= ReadWarnings::maxKept + 1);
    for (const std::string& text : texts)
        FUZZ_CHECK(!text.empty() && text.find('\n') == std::string::npos);
    FUZZ_CHECK(strictReads == (lenientReads && texts.empty()));
}

} // namespace pacini
