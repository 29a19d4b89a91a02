"""report.html and the plot of a run: one file each that tells what the run's directory knows."""
