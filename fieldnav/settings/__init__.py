"""Settings that people write: crop profiles, robots and fields, as YAML checked by pydantic."""
