"""What pages state: measured figures with the commands that print them, and numbers of the code that pages repeat."""
