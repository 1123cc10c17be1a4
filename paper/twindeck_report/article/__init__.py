"""Our article on the study as a PDF: the text in paper/article, with the generated tables and figures and the numbers as macros."""
