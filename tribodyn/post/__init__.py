"""What is made from records: spectra, figures and the summary on the terminal."""
