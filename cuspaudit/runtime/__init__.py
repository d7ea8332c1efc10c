"""What a run needs beside mathematics: its process, its files, its versions."""
