/* For every processor of this kind. */
#define PREFIX plain_
#include "rows_body.h"
