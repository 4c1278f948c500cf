"""Table 5.1: parameters of the linear models, from the data sheets."""
