"""Doors, flaps and drawers: their layout, leaves, handles, boxes and what lies behind them. They know no case."""
