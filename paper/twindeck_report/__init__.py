"""Tables, figures, report and paper check of a study: everything that comes after the steps' own results."""
