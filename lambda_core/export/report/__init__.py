"""Pictures and pages about results: views chosen and drawn, reports written."""
