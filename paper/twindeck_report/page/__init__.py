"""The parts of report.html that every study has, with or without a printed paper: flowchart, mode shapes, stabilisation diagrams,
diagnosis, provenance. Each module makes one part's data; templates/parts/ holds its markup, assets/ its style and scripts."""
