#include "train/simulation/engine.h"
