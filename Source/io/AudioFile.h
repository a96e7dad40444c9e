#pragma once

// Audio files: their reader and their writer.

#include "io/AudioReader.h"
#include "io/AudioWriter.h"
