"""Contacts of the cage with balls and rings, ball with ball. Compiled."""
