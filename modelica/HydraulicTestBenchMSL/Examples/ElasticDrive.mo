within HydraulicTestBenchMSL.Examples;
model ElasticDrive "Pump on a drive of the standard library, with a command of its blocks"
  extends Modelica.Icons.Example;
  Modelica.Mechanics.Rotational.Sources.ConstantSpeed motor(w_fixed=151.8436) "Motor at 1450 rpm";
  Modelica.Mechanics.Rotational.Components.SpringDamper coupling(c=2e4, d=20) "Elastic coupling";
  Modelica.Mechanics.Rotational.Components.Inertia rotor(
    J=0.012, w(start=151.8436, fixed=true), phi(start=0, fixed=true)) "Mass of the pump's rotor";
  Modelica.Blocks.Sources.Ramp command(height=60, duration=0.3, startTime=0.1) "Command in percent";
  Modelica.Blocks.Sources.Constant rate(k=0) "Rate of the command: not told";
  HydraulicTestBench.Pump.A4VSG pump(redeclare HydraulicTestBench.Pump.MeanFlow pumpFlow) "Pump";
  HydraulicTestBench.Hydraulics.Volume volume(V=1e-3, beta=1.4e9) "Line";
  HydraulicTestBench.Hydraulics.Orifice load(K=6e-6, rho=875) "Load";
  HydraulicTestBench.Hydraulics.Tank tank "Tank";
equation
  connect(motor.flange, coupling.flange_a);
  connect(coupling.flange_b, rotor.flange_a);
  connect(rotor.flange_b, pump.shaft);
  connect(command.y, pump.alphaCMD);
  connect(rate.y, pump.alphaCMD_t);
  connect(pump.port_A, volume.port_a);
  connect(volume.port_b, load.port_a);
  connect(load.port_b, tank.port);
  connect(pump.port_B, tank.port);
  connect(pump.port_D, tank.port);
  annotation(
    experiment(StartTime=0, StopTime=1, Interval=0.001, Tolerance=1e-7),
    Documentation(info="<html>
<p>In the end the twist of the coupling is the pump's torque over its stiffness, and the pressure that at which the
orifice passes the pump's flow.</p>
<p><b>Source:</b> thesis Eq. 3.48 for the pump; Modelica Standard Library for its drive.</p>
</html>"));
end ElasticDrive;
