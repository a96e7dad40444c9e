// The module of Pacini's own method: encoding of sounds, edits over the clips, and settings, those of the live
// translator among them.

#include "web/core/Call.h"

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr NamedHandler all[]{{"encode", encodeSound},
                                        {"reapply", reapplyEdits},
                                        {"parameters", describeParameters},
                                        {"live", readLive},
                                        {"liveParameters", describeLive}};
    return all;
}

} // namespace pacini::web
