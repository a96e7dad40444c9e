// The module pacini._native: implementation of the package behind its public interface.

#include "io/SoundLibraryCall.h"
#include "python/native/Support.h"

namespace pacini::python
{

NB_MODULE(_native, module)
{
    module.doc() = "Pacini's core. Use the package pacini, which is made of it; this changes without notice.";
    muteSoundLibraries();
    bindProfile(module);
    bindClip(module);
    bindEncode(module);
    bindRender(module);
    bindCompare(module);
    bindAudio(module);
    bindTranslator(module);
    bindTextures(module);
    bindMeasure(module);
    module.def("wait_for_abandoned_work", [] { unlocked([] { AbandonedWork::wait(); }); });
    module.attr("VERSION") = PACINI_VERSION;
}

} // namespace pacini::python
