#pragma once

// The film has a room of its own.
#include "models/array/film/layered_film.h"
