"""The Python functions of the product: load, functionalize, look at the result, change it, save it."""
