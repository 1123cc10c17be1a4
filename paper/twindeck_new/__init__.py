"""`twindeck new NAME --from FILES`: a study out of records, a table of sensors and a model, as they lie there."""
