within Drive;
package Slots "What may be missing, and where"
  partial model PartialForce "A force on the carriage beside that of the spindle"
    input Real x(unit="m") "Position of the carriage";
    input Real v(unit="m/s") "Its velocity";
    output Real f(unit="N") "Force, positive towards positive x";
  end PartialForce;

  partial model PartialTorque "A torque on the shaft beside those of motor and spindle"
    input Real phi(unit="rad") "Angle of the shaft";
    input Real w(unit="rad/s") "Its velocity";
    output Real tau(unit="N.m") "Torque, positive towards positive phi";
  end PartialTorque;

  model NoForce "Nothing"
    extends PartialForce;
  equation
    f = 0;
  end NoForce;

  model NoTorque "Nothing"
    extends PartialTorque;
  equation
    tau = 0;
  end NoTorque;
end Slots;
