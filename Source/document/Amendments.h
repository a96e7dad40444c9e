#pragma once

// Changes of a document that are no step of undo: all its states have them then.

#include "document/Document.h"

#include <pacini/foundation/Result.h>

#include <string>

namespace pacini
{

/// Adds a clip that is its own analysis (imported, or made by hand); its id. Errors: those of validate(clip).
Result<int> addClip(Document& document, Clip clip);

/// Adds a sound and the clip that analyse() made of it, as addClip() does.
Result<int> addSound(Document& document, AudioReference sound, const EncoderParams& encoder, Clip analysis);

/// Sets what the clips are felt with. Errors: invalidArgument for the strength, those of validate(*profile.embedded).
Result<void> setProfile(Document& document, const ProjectProfile& profile);

/// Adds the clips of a scene, in a group, and puts the scene itself in place of the present one, which is a step with
/// a name; none where there was no scene. Errors: those of validate().
Result<void> openScene(Document& document, const Scene& scene, const std::string& group, std::string name);

} // namespace pacini
