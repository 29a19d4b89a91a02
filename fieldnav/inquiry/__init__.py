"""What past runs did, and why: journals read in part, filtered, judged, compared and explained."""
