#pragma once

// Audio files in and out.

#include "io/AudioReader.h"
#include "io/AudioWriter.h"
