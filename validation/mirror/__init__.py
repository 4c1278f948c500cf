"""The SimulationX model of Appendix F, block by block, beside the pump block of the library."""
