"""What the thesis did, on our files, in parts that are stored: agents, classifiers, and the files of both."""
