model RotorOnBearing "A rigid rotor on one bearing: the FMU of a bearing that was exported with --couple motion"
  // Import the FMU first; OpenModelica: importFMU("bearing.fmu"), Dymola: File > Open > Import FMU. Put the name of the
  // block that it makes in the place of Bearing. Tools that allow no dots in names write inner_ring_x or
  // inner_ring.x as here.
  parameter Modelica.Units.SI.Mass m = 2 "rotor with the inner ring";
  parameter Modelica.Units.SI.Force axial = 1300 "load of the case, under which the bearing starts";
  parameter Modelica.Units.SI.Force push = -500 "vertical, from 1 ms on";
  parameter Modelica.Units.SI.Position x0 = 1.572e-4 "start of inner_ring.x in the description of the FMU";
  Bearing bearing;
  Modelica.Units.SI.Position r[3](start = {x0, 0, 0}, each fixed = true);
  Modelica.Units.SI.Velocity v[3](each start = 0, each fixed = true);
  Modelica.Units.SI.Acceleration a[3];
equation
  der(r) = v;
  der(v) = a;
  m * a = {bearing.inner_ring.reaction_force_x + axial, bearing.inner_ring.reaction_force_y,
           bearing.inner_ring.reaction_force_z + (if time > 1e-3 then push else 0)};
  {bearing.inner_ring.x, bearing.inner_ring.y, bearing.inner_ring.z} = r;
  {bearing.inner_ring.x_rate, bearing.inner_ring.y_rate, bearing.inner_ring.z_rate} = v;
  {bearing.inner_ring.x_acceleration, bearing.inner_ring.y_acceleration, bearing.inner_ring.z_acceleration} = a;
  annotation(experiment(StopTime = 0.01, Interval = 2e-5));
end RotorOnBearing;
