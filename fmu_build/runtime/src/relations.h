/* Relations, which are constant between events, and the event indicators behind them. */
#ifndef RELATIONS_H
#define RELATIONS_H

#include "instance.h"

/* Sets every relation to what holds now (those of time: to what holds just after now, once initialised). */
Status relations_update(Instance *s, bool *changed);

/* Event indicators (n_state_relations), shifted away from zero by a hysteresis on the relation's present side. */
Status relations_indicators(Instance *s, double *z);

/* True if an indicator, as given by relations_indicators, lies on the other side than its relation `k`-th. */
bool relation_is_crossed(const Instance *s, size_t k, double z);

/* True in `crossed` if any relation no longer fits the present point; also widens the known range of indicators. */
Status relations_are_crossed(Instance *s, bool *crossed);

/* Two times closer than this are one event, s. */
double time_slack(const Instance *s);

#endif
