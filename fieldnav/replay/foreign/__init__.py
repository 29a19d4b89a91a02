"""A drive that others have recorded, through the mission: what fieldnav would have done."""
