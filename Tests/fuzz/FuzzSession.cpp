// Any text is refused with a proper error or is the log of a session, of whole lines only.

#include "FuzzText.h"
#include "study/SessionLog.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return fuzzReader(
        data, size, [](std::string_view given) { return study::sessionOfText(given); },
        [](const auto& session, std::string_view text)
        {
            FUZZ_CHECK(session.goodBytes <= text.size());
            FUZZ_CHECK(session.goodBytes > 0 && text[session.goodBytes - 1] == '\n');
            // What was being written when the program ended makes no difference.
            const auto whole = study::sessionOfText(text.substr(0, session.goodBytes));
            FUZZ_CHECK(whole.ok() && whole->records.size() == session.records.size());
            FUZZ_CHECK(whole->finished == session.finished && whole->events == session.events);
        });
}
