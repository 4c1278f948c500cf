"""The test bench of thesis Chapter 5: its linear models, its energy, its controllers, its speed."""
