"""The documentation as one folder of static pages: guides, reference, decisions, a gallery of the studies, the C++ headers."""
