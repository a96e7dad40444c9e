// The module of the web page: what a visit needs, in one, since several modules would each bring the same parsers.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"encode", encodeSound},    NamedHandler{"reapply", reapplyEdits},
        NamedHandler{"defaults", tellDefaults}, NamedHandler{"formats", listFormats},
        NamedHandler{"read", readClipBytes},    NamedHandler{"write", writeClipBytes},
        NamedHandler{"lint", lintClip},         NamedHandler{"render", renderClipOrScene},
        NamedHandler{"compare", compareSounds}, NamedHandler{"spectrogram", drawSpectrogram},
        NamedHandler{"reports", listReports},   NamedHandler{"rumble", planRumble},
        NamedHandler{"touch", planTouch},
    };
    return all;
}

} // namespace pacini::web
