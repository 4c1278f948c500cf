"""Work that is killed goes on, or begins anew, and ends in the same result."""
