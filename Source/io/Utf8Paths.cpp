// Paths from texts in UTF-8 on Windows, where libstdc++ takes each byte of a text for a character, but writes paths as
// UTF-8. The linker puts this function in the place of its own (Source/CMakeLists.txt).
#if defined(__MINGW32__)

#include <windows.h>

#include <cwchar>
#include <locale>

using Conversion = std::codecvt<wchar_t, char, std::mbstate_t>;

/// What is no UTF-8 becomes U+FFFD, of which there is no file.
extern "C" std::codecvt_base::result
__wrap__ZNKSt7codecvtIwciE5do_inERiPKcS3_RS3_PwS5_RS5_(const Conversion* /*unused*/, std::mbstate_t& /*unused*/,
                                                       const char* from, const char* fromEnd, const char*& fromNext,
                                                       wchar_t* to, wchar_t* toEnd, wchar_t*& toNext)
{
    const int size = static_cast<int>(fromEnd - from);
    const int room = static_cast<int>(toEnd - to);
    const int written = size == 0 ? 0 : MultiByteToWideChar(CP_UTF8, 0, from, size, to, room);
    const bool done = size == 0 || written > 0;
    fromNext = done ? fromEnd : from;
    toNext = to + written;
    return done ? std::codecvt_base::ok : std::codecvt_base::partial; // with more room it is called again
}

#endif
