// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/LanguageProblem.h"

#include "editor/Translation.h"

#include <iostream>

namespace pacini::editor
{

namespace
{
juce::String codeAskedFor()
{
    const auto code = languageAskedFor();
    return code.isEmpty() ? systemLanguage() : code;
}
} // namespace

juce::String languageChoice(const juce::String& code)
{
    return canShow(code) ? languageName(code) : tr("{0} (needs a font)", {tr("Japanese")});
}

juce::String missingFont(const juce::String& code)
{
    if (canShow(code.substring(0, 2).toLowerCase()))
        return {};
#if JUCE_LINUX || JUCE_BSD
    return tr("Japanese needs a font. Install fonts-noto-cjk or fonts-ipafont and start again; until then it is "
              "English.");
#else
    return tr("Japanese needs a font. Install one and start again; until then it is English.");
#endif
}

juce::String languageProblem()
{
    const auto code = codeAskedFor();
    if (const auto missing = missingFont(code); missing.isNotEmpty())
        return missing;
    if (languageAskedFor().isEmpty() || code.substring(0, 2).toLowerCase() == languageInUse())
        return {};
    return tr("There are no texts in {0}, so it is English. Choose en or one of {1}.",
              {code, languages().joinIntoString(", ")});
}

void tellLanguageProblem(const char* program)
{
    if (const auto problem = languageProblem(); problem.isNotEmpty())
        std::cerr << program << ": language " << codeAskedFor() << ": " << problem << std::endl;
}

} // namespace pacini::editor
