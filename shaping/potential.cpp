#include "shaping/potential.h"
