# Run by Godot 3: writes the texels of each imported table, as they lie in memory, beside the project.
extends SceneTree

func _init():
	for name in ["M", "N_TT_R", "N_TRT"]:
		var image = load("res://hair/%s.exr" % name).get_data()
		var file = File.new()
		file.open("res://%s_%d.texels" % [name, image.get_format()], File.WRITE)
		file.store_buffer(image.get_data())
		file.close()
	quit()
