"""Random draws of styles: traditions, finishes, hardware, casework and fronts. The families draw from these."""
