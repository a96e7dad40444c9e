// The module of Pacini's own method: encoding of sounds, and edits over the clips.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"encode", encodeSound},
        NamedHandler{"reapply", reapplyEdits},
        NamedHandler{"parameters", describeParameters},
    };
    return all;
}

} // namespace pacini::web
