"""What a case of any study begins with, what its run and its check end in, and what a run takes."""
