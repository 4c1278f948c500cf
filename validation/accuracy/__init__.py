"""How near black box, locked, free and diagnosed model come to one pump, by the thesis' own criteria."""
