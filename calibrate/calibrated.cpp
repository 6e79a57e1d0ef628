#include "calibrate/calibrated.h"
