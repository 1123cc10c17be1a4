"""The reference page: every key of every configuration from the executables' own field tables, every column of the files."""
