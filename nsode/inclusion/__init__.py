"""Stage 2: from the model as written to the differential inclusion in normal form."""
