"""Every example compiled by our own chain and by OpenModelica, compared variable by variable."""
